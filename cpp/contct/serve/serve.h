/* The program as functions: texts in, texts out. For other languages, and for a page.
 *
 * `problem` is the text of a problem file (reference/problem-file.md), in UTF-8, ended by a zero. `options`
 * is a JSON object, or null for none; an option that is not known is refused. Every function returns a JSON
 * object
 *
 *   "format"    "contct-answer-1"
 *   "exit"      0: as the program's exit status (reference/running.md)
 *   "messages"  []: warnings, and what the program prints on standard error, a text each
 *   "error"     null, or { "message": "..", "file": "problem", "line": 12, "column": 3 }; the last three are
 *               null where the message has no place
 *   "result"    as the function says; null where there is an error
 *
 * and what the options ask for, as a text that is the caller's, who frees it by contct_free. Null is returned
 * where memory does not suffice for an answer. Nothing is printed, no exception leaves, and no file is
 * written; files are read only where a problem names them (stiffness = "K.mtx"), in `folder`.
 *
 * Any function may be called from any thread. What calls the 1989 code waits for its turn, since COMMON /DOF/
 * and unit 26 belong to the whole process; contct_check, contct_certify and contct_exact without kernels do
 * not.
 *
 * Options that all functions with a problem have:
 *   "file"    its name in messages and pages: "problem"
 *   "folder"  in front of that name where it does not begin with "/", and where files that the problem names
 *             are looked for; "": where the process runs
 *   "allow_outside"
 *             false: a problem that names files which are not below that folder is refused, since a problem
 *             from a stranger must not read what its user can; true: any file */
#ifndef CONTCT_SERVE_SERVE_H
#define CONTCT_SERVE_SERVE_H

#if defined(__GNUC__)
#define CONTCT_SERVE_EXPORT __attribute__((visibility("default")))
#else
#define CONTCT_SERVE_EXPORT
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* clang-format off: lists stay lists */

/* The version of this interface. It changes when anything declared here does. */
#define CONTCT_SERVE_VERSION 1
CONTCT_SERVE_EXPORT int contct_serve_version(void);

/* "result": { "version": "0.2.0", "listing_sha256", "floating_point", "lapack", "kernels": [{ "name",
 *   "real_bytes", "rule", "language", "compiler", "flags" }], "engines": ["auto", ..] }. */
CONTCT_SERVE_EXPORT char* contct_about(void);

/* contct run: follow the path of a problem. "result" is what --json writes (reference/result-file.md).
 *   "kernels"         the first leads; without it, "corrected" gives the answer, beside the 1989 path
 *   "engine"          as --engine; without it, what suits the leader
 *   "final_only"      false; true: no path, the equilibrium under each step's load
 *   "envelope"        false
 *   "max_increments"  0, the program's own limit
 *   "page", "log", "trace", "proof"
 *                     false; true: the answer has what --html, --log, --trace and --proof write, as a text
 *                     under the same key
 *   "states"          false; true: the result has the structure, and states within steps, for a picture */
CONTCT_SERVE_EXPORT char* contct_run(const char* problem, const char* options);

/* contct check: read a problem, solve nothing. "result": { "title", "kind": "beam" | "plate" | "matrix",
 *   "nodes", "dofs", "elements", "pairs", "steps": [names], "units": null or { "length", "force" },
 *   "x", "y": of every node of a plate; a beam has "x" alone }.
 *   "places"  false; true: the result has where what is written too: "numbers": [{ "key": "contact[1].face",
 *             "value", "whole", "line", "column", "length" }], with "pair_list" */
CONTCT_SERVE_EXPORT char* contct_check(const char* problem, const char* options);

/* contct exact: the path in rational arithmetic. "result" is what contct exact --json writes.
 *   "rule"     "corrected" or "1989"
 *   "kernels"  [], compared with it */
CONTCT_SERVE_EXPORT char* contct_exact(const char* problem, const char* options);

/* contct explain: what each line of the listing did. "result" is what contct explain --json writes.
 *   "kernels"          ["fortran", "cpp"], one or two of the 1989 rule
 *   "engine"           "refactor"
 *   "step", "increment"  all of them; or one, from 1 */
CONTCT_SERVE_EXPORT char* contct_explain(const char* problem, const char* options);

/* Bounds on the errors of states from elsewhere. "result" is as contct_run's, without increments: `w`,
 * `pairs`, `error` and `certificate` of each state as it was given.
 *   "displacement"  [[..], ..]: a state for each of the first steps, every dof, under the step's whole load.
 * A pair counts as closed where the state touches or enters its face "closed"        [[..], ..]: the pairs
 * that are closed instead, from 1 */
CONTCT_SERVE_EXPORT char* contct_certify(const char* problem, const char* options);

/* One call of a kernel: the arguments of contct_kernel (contct/kernel/plugin.h), behind the kernel's name.
 * "result": { "text": what it wrote to unit 26 }. A call whose id or dimensions lead outside the arrays is
 * refused. */
CONTCT_SERVE_EXPORT char* contct_call(const char* kernel, const double dd[], const double dtest[],
                                      const double cc[], double ss[], double* smin, const int id[],
                                      int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof);

/* A kernel of the caller's, as contct_kernel of contct/kernel/plugin.h. It is called in this process. */
/* NOLINTNEXTLINE(modernize-use-using): this is C */
typedef void contct_kernel_function(const double dd[], const double dtest[], const double cc[], double ss[],
                                    double* smin, const int id[], int isep[], const int isurf[], int nc,
                                    int indof, int ndofpn, int ndof);

/* contct fuzz: put random and adversarial calls and whole problems to a kernel of the caller's, and compare
 * it with the 1989 code. "result" is what contct fuzz --json writes; "exit" is 1 where the two differ.
 *   "leader"  "fortran"
 *   "name"    "function"
 *   "calls"   20000; "problems" 40; "seed" 1989 */
CONTCT_SERVE_EXPORT char* contct_judge(contct_kernel_function* kernel, const char* options);

/* contct replay: a recorded trace, as a text, put to a kernel. "result": { "kernel", "calls",
 *   "values_compared", "mismatches", "first": null or words }.
 *   "file"    "trace"
 *   "kernel"  the 1989 code in the trace's precision */
CONTCT_SERVE_EXPORT char* contct_replay(const char* trace, const char* options);

/* Free what any of these returned; null is allowed. */
CONTCT_SERVE_EXPORT void contct_free(char* text);

/* clang-format on */

#ifdef __cplusplus
}
#endif

#endif
