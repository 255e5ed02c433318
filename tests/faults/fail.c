/* A library to preload, which makes a system call fail, for tests. Environment variables:
 *
 * - FAULT_CALL: the name of the system call: "write", "openat", ..
 * - FAULT_AT: the number of the call that fails, counted from 1, also before main; 0: no call fails
 * - FAULT_ERRNO: the error number of the failing call
 * - FAULT_MORE: if set, all later calls fail too
 * - FAULT_SIGNAL: a signal that the process gets at this call instead of the failure
 * - FAULT_COUNT: a file to which the number of calls is written at the end
 *
 * seccomp stops every call of this name, and the handler of SIGSYS makes the call or lets it fail. Calls
 * inside the C library are therefore counted too. */
#define _GNU_SOURCE
#include <errno.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

static const unsigned long let_pass = 0x636f6e74; /* the sixth argument of calls that seccomp allows */
static volatile int armed = 0;
static long at = 0, error_number = 0;
static int more = 0, signal_instead = 0;
static volatile long calls = 0;
static pid_t program = 0; /* child processes do not fail */

static int must_fail(void) {
  if (getpid() != program) return 0;
  const long number = __atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST);
  const int now = at > 0 && (number == at || (more && number > at));
  if (!now || signal_instead == 0) return now;
  (void)kill(getpid(), signal_instead);
  return 0;
}

static const struct {
  const char* name;
  int number;
} known_calls[] = {
    {"write", SYS_write},   {"read", SYS_read},     {"openat", SYS_openat}, {"close", SYS_close},
    {"fsync", SYS_fsync},   {"pread", SYS_pread64}, {"fcntl", SYS_fcntl},   {"lseek", SYS_lseek},
    {"fchmod", SYS_fchmod}, {"rename", SYS_rename}, {"mkdir", SYS_mkdir},
};

/* True for a file in memory, such as that of unit 26, and for a channel to a child process. A full disk
 * cannot make their calls fail. */
static int is_on_no_disk(int number, const unsigned long a[5]) {
  char link[64];
  char target[64] = "";
  if (number != SYS_write && number != SYS_read && number != SYS_pread64 && number != SYS_lseek) return 0;
  snprintf(link, sizeof link, "/proc/self/fd/%ld", (long)a[0]);
  if (readlink(link, target, sizeof target - 1) <= 0) return 0;
  const int is_channel = strncmp(target, "pipe:", 5) == 0 || strncmp(target, "socket:", 7) == 0;
  return strncmp(target, "/memfd:", 7) == 0 || (is_channel && a[0] > STDERR_FILENO);
}

static void caught(int signal_number, siginfo_t* info, void* context) {
  (void)signal_number;
  const int before = errno;
  greg_t* const r = ((ucontext_t*)context)->uc_mcontext.gregs;
  const unsigned long a[5] = {(unsigned long)r[REG_RDI], (unsigned long)r[REG_RSI], (unsigned long)r[REG_RDX],
                              (unsigned long)r[REG_R10], (unsigned long)r[REG_R8]};
  if (armed && !is_on_no_disk(info->si_syscall, a) && must_fail()) {
    r[REG_RAX] = -error_number;
  } else {
    const long answer = syscall(info->si_syscall, a[0], a[1], a[2], a[3], a[4], let_pass);
    r[REG_RAX] = answer < 0 ? -errno : answer;
  }
  errno = before;
}

static int catch_calls(int number) {
  const struct sigaction action = {.sa_sigaction = caught, .sa_flags = SA_SIGINFO | SA_NODEFER};
  struct sock_filter filter[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch)),
                                 BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AUDIT_ARCH_X86_64, 0, 5),
                                 BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
                                 BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (unsigned)number, 0, 3),
                                 BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[5])),
                                 BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (unsigned)let_pass, 1, 0),
                                 BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
                                 BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const struct sock_fprog filters = {sizeof filter / sizeof filter[0], filter};
  if (sigaction(SIGSYS, &action, NULL) != 0 || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return -1;
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filters);
}

/* Never blocks SIGSYS, because a stopped call would then end the process. */
int pthread_sigmask(int how, const sigset_t* set, sigset_t* before) {
  sigset_t without;
  if (set != NULL) {
    without = *set;
    if (how != SIG_UNBLOCK) sigdelset(&without, SIGSYS);
  }
  return sigprocmask(how, set != NULL ? &without : NULL, before) == 0 ? 0 : errno;
}

/* Keeps the handler of SIGSYS when a child process resets its signal handlers. */
void (*signal(int number, void (*handler)(int)))(int) {
  const struct sigaction action = {.sa_handler = handler, .sa_flags = SA_RESTART};
  struct sigaction before;
  if (number == SIGSYS) return SIG_DFL;
  return sigaction(number, &action, &before) == 0 ? before.sa_handler : SIG_ERR;
}

static long number_in(const char* variable) {
  const char* const text = getenv(variable);
  return text != NULL ? atol(text) : 0;
}

__attribute__((constructor)) static void arm(void) {
  const char* const call = getenv("FAULT_CALL");
  int number = -1;
  if (call == NULL) return;
  at = number_in("FAULT_AT");
  error_number = number_in("FAULT_ERRNO");
  signal_instead = (int)number_in("FAULT_SIGNAL");
  more = getenv("FAULT_MORE") != NULL;
  for (size_t i = 0; i < sizeof known_calls / sizeof known_calls[0]; ++i)
    if (strcmp(call, known_calls[i].name) == 0) number = known_calls[i].number;
  if (number < 0 || catch_calls(number) != 0) {
    fprintf(stderr, "fail.c: %s cannot be caught here\n", call);
    _exit(99);
  }
  program = getpid();
  armed = 1;
}

__attribute__((destructor)) static void write_count(void) {
  const char* const count_file = getenv("FAULT_COUNT");
  armed = 0;
  FILE* const file = count_file != NULL && getpid() == program ? fopen(count_file, "w") : NULL;
  if (file == NULL) return;
  fprintf(file, "%ld\n", calls);
  fclose(file);
}
