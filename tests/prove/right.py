"""right.py BUILD ROOT LEAST [NUMBER..]: tests that right kernels of several shapes, compilers and options are proved, at
least LEAST of the rows with these numbers (all without numbers), and that wrong kernels of the same shapes are not."""

import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

build, root, least = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])
sys.path[:0] = [str(build), str(root / "tests/support")]
from contct_prove import Undecided
from contct_prove.elf import Image
from contct_prove.induction import Differs, Proof
from contct_prove.interfaces import plugin
from contct_prove.machine import Machine
from contct_prove.specification import Specification
from edits import edited
from testing import run

PLAIN = (root / "reference/kernels/contct_kernel.c").read_text()
BY_COMPARISON = [("static double scale_factor", "static double absolute(double x) { if (x < 0) x = -x; return x; }\n\nstatic double scale_factor"),
                 ("if (fabs(gap) <", "if (absolute(gap) <"), ("if (fabs(ss[i] - *smin)", "if (absolute(ss[i] - *smin)")]  # fmt: skip
OWN_FABS = [("#include <math.h>", "#include <string.h>\nHIDDEN double fabs(double x) {\n  unsigned long b;\n  __builtin_memcpy(&b, &x, 8);\n"
             "  b &= ~0ul >> 1;\n  __builtin_memcpy(&x, &b, 8);\n  return x;\n}")]  # fmt: skip
HEAD = """#include <contct/kernel/plugin.h>
#include <math.h>
int contct_kernel_abi(void) { return CONTCT_KERNEL_ABI; }
void contct_kernel(const double dd[], const double dtest[], const double cc[], double ss[], double* smin, const int id[],
                   int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof) {
"""
SELECT = HEAD + """  double least = 1;
  for (int k = 0; k != nc; k++) {
    const int n = (id[k] - 1) * ndofpn + indof - 1;
    const double move = dtest[n], gap = cc[k] - dd[n], sign = isep[k] * isurf[k] / move;
    const double near = sign > 0 ? sign * 1e-20 : 1.0, far = gap / move;
    const double s = move == 0 ? 1.0 : fabs(gap) < 1e-10 ? near : far;
    ss[k] = s;
    least = s > 0 && s < least ? s : least;
  }
  *smin = least;
  if (least != 1)
    for (int k = 0; k != nc; k++) {
      const int other = isep[k] == 1 ? -1 : 1;
      isep[k] = fabs(ss[k] - least) / least < 0.00390625 ? other : isep[k];
    }
}
"""
WALK = HEAD + """  const double *d = dd + indof - 1, *move = dtest + indof - 1;
  const double* const end = ss + nc;
  const int *node = id, *side = isurf, *status = isep;
  *smin = 1;
  for (double* s = ss; s < end; ++s, ++cc, ++node, ++side, ++status) {
    const long n = (*node - 1) * ndofpn;
    const double gap = *cc - d[n];
    if (move[n] == 0)
      *s = 1;
    else if (fabs(gap) < 1e-10) {
      const double sign = *status * *side / move[n];
      *s = sign > 0 ? sign * 1e-20 : 1;
    } else
      *s = gap / move[n];
    if (*s > 0 && *s < *smin) *smin = *s;
  }
  if (*smin == 1) return;
  for (const double* s = ss; s != end; ++s, ++isep)
    if (fabs(*s - *smin) / *smin < 1. / 256) *isep = *isep == 1 ? -1 : 1;
}
"""
RUST = """#![no_std]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! { loop {} }
#[no_mangle]
pub extern "C" fn contct_kernel_abi() -> i32 { 1 }
fn magnitude(x: f64) -> f64 { f64::from_bits(x.to_bits() & !(1 << 63)) }
#[no_mangle]
pub unsafe extern "C" fn contct_kernel(dd: *const f64, dtest: *const f64, cc: *const f64, ss: *mut f64, smin: *mut f64,
    id: *const i32, isep: *mut i32, isurf: *const i32, nc: i32, indof: i32, ndofpn: i32, _ndof: i32) {
    let mut least = 1.0;
    let mut i = 0;
    while i < nc as usize {
        let n = (*id.add(i)).wrapping_sub(1).wrapping_mul(ndofpn).wrapping_add(indof).wrapping_sub(1) as isize;
        let (d_star, gap) = (*dtest.offset(n), *cc.add(i) - *dd.offset(n));
        let s = if d_star == 0.0 { 1.0 } else if magnitude(gap) < 1e-10 {
            let sign = (*isep.add(i)).wrapping_mul(*isurf.add(i)) as f64 / d_star;
            if sign > 0.0 { sign * 1e-20 } else { 1.0 }
        } else { gap / d_star };
        *ss.add(i) = s;
        if s > 0.0 && s < least { least = s; }
        i += 1;
    }
    *smin = least;
    if least == 1.0 { return; }
    i = 0;
    while i < nc as usize {
        if magnitude(*ss.add(i) - least) / least < 0.00390625 { *isep.add(i) = if *isep.add(i) == 1 { -1 } else { 1 }; }
        i += 1;
    }
}
"""
FORTRAN = (root / "reference/kernels/contct_kernel.f90").read_text()
COMPARES = edited(PLAIN, BY_COMPARISON)
NO_BUILTIN = ' -fno-builtin -DHIDDEN=__attribute__((visibility("hidden")))'
LEVELS = [f"-O{n}" for n in range(4)]
RIGHT = [(shape, compiler, level, source) for shape, source in (("ABS by comparison", COMPARES), ("select", SELECT), ("pointers", WALK))
         for compiler in ("gcc", "clang") for level in LEVELS]  # fmt: skip
RIGHT += [("plain", "gcc", "-O2 -funroll-loops", PLAIN), ("plain", "gcc", "-O1 -funroll-loops", PLAIN), ("plain", "clang", "-O3 -funroll-loops", PLAIN),
          ("plain", "gfortran", "-O2 -funroll-loops", FORTRAN), ("plain", "gcc", "-O2 -fstack-protector-all", PLAIN),
          ("plain", "clang", "-O0 -fstack-protector-all", PLAIN), ("own fabs", "gcc", "-O2" + NO_BUILTIN, edited(PLAIN, OWN_FABS)),
          ("own fabs", "clang", "-O1" + NO_BUILTIN, edited(PLAIN, OWN_FABS))]  # fmt: skip
RIGHT += [("Rust", "rustc", level, RUST) for level in ["-O0 -C debug-assertions=no", *LEVELS[1:]]]
WRONG = [  # the same shapes with a fault: any verdict but proved
    ("fabs by PLT", "gcc", "-O2 -fno-builtin", PLAIN),
    ("ABS of a larger gap", "gcc", "-O2", edited(COMPARES, [("x < 0", "x < -1e-300")])),
    ("select, a tie is later", "gcc", "-O2", edited(SELECT, [("s < least ?", "s <= least && s != 1 ?"), ("< 1e-10 ?", "<= 1e-10 ?")])),
    ("select, SMIN of zero", "clang", "-O1", edited(SELECT, [("s > 0 && s", "s >= 0 && s")])),
    ("pointers, the last pair is left out", "gcc", "-O2", edited(WALK, [("ss + nc", "ss + nc - 1")])),
    ("unrolled, a fault at one pair of eight", "gcc", "-O2 -funroll-loops", edited(PLAIN, [("-1 : 1;", "(i & 7) == 5 && i == nc - 3 ? 1 : -1 : 1;")])),
]
COMPILE = {"rustc": "rustc --crate-type cdylib -C panic=abort -C opt-level={} -A warnings mine.rs -o mine.so",
           "gfortran": "gfortran -ffp-contract=off -shared -fPIC -Wl,-Bsymbolic {} mine.f90 -o mine.so"}  # fmt: skip


def verdict(row: tuple[str, str, str, str]) -> bool:
    """Builds a kernel, prints the verdict of the prover with the processor time, and returns True if it is proved."""
    shape, compiler, options, source = row
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, {"rustc": "mine.rs", "gfortran": "mine.f90"}.get(compiler, "mine.c")).write_text(source)
        command = COMPILE.get(compiler, compiler + " -ffp-contract=off -shared -fPIC {} -I " + f"{root}/cpp mine.c -o mine.so -lm")
        run(*command.format(options.removeprefix("-O") if compiler == "rustc" else options).split(), cwd=folder, status=0)
        machine = Machine(Image(f"{folder}/mine.so"), Specification(64))
    begin, words = time.process_time(), "proved"
    try:
        Proof(machine, plugin(machine), machine.image.symbol("contct_kernel").address).prove()
    except (Undecided, Differs, LookupError) as why:
        words = f"not proved: {why}"
    print(f"{shape}; {compiler} {options}; {time.process_time() - begin:.1f} s; {words[:230]}", flush=True)
    return words == "proved"


if __name__ == "__main__":
    asked = [RIGHT[int(n) - 1] for n in sys.argv[4:]] or RIGHT
    with ProcessPoolExecutor(2) as pool:
        right = list(pool.map(verdict, asked))
        wrong = list(pool.map(verdict, WRONG if asked is RIGHT else WRONG[:1]))
    print(f"{right.count(True)} of {len(right)} right kernels are proved; {wrong.count(True)} of {len(wrong)} wrong ones")
    sys.exit(0 if right.count(True) >= least and not any(wrong) else 1)
