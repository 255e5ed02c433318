# Loads every register from the state on the next page, executes one instruction, and stores every register. The state
# has 16 general registers in the order of their numbers, flags, whether the instruction jumped to `landing`, 16 vector
# registers, and the caller's stack pointer.
.set general, stub + 4096
.set flags, general + 128
.set landed, flags + 8
.set vectors, landed + 8
.set kept, vectors + 256
.macro each what
  \what 0, rax
  \what 1, rcx
  \what 2, rdx
  \what 3, rbx
  \what 4, rsp
  \what 5, rbp
  \what 6, rsi
  \what 7, rdi
  .irp k, 8, 9, 10, 11, 12, 13, 14, 15
    \what \k, r\k
  .endr
.endm
.macro in k, register
  mov general+8*\k(%rip), %\register
.endm
.macro out k, register
  mov %\register, general+8*\k(%rip)
.endm
stub:
  .irp r, rbx, rbp, r12, r13, r14, r15
    push %\r
  .endr
  mov %rsp, kept(%rip)
  .irp k, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    movups vectors+16*\k(%rip), %xmm\k
  .endr
  push flags(%rip)
  popfq
  each in
  .skip 32, 0x90  # the instruction, and bytes that fault if it is longer than expected
  jmp after
landing:
  movq $1, landed(%rip)
after:
  each out
  mov kept(%rip), %rsp
  pushfq
  pop flags(%rip)
  .irp k, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15
    movups %xmm\k, vectors+16*\k(%rip)
  .endr
  cld
  .irp r, r15, r14, r13, r12, rbp, rbx
    pop %\r
  .endr
  ret
