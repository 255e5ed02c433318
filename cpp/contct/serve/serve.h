/* The program as C functions with texts as arguments and results, for other languages and for a web page.
 *
 * `problem` is the text of a problem file (reference/problem-file.md), in UTF-8, ended by a zero. `options`
 * is a JSON object, or null for none; an unknown option is refused. Every function with `options`, and
 * contct_about and contct_call, return a JSON object with these keys and those that the options request:
 *
 *   "format"    "contct-answer-1"
 *   "exit"      the exit status that the program would have (reference/running.md)
 *   "messages"  a list of texts: warnings, and what the program prints on standard error
 *   "error"     null, or { "message": "..", "file": "problem", "line": 12, "column": 3 }; "file", "line" and
 *               "column" are null if the message has no place
 *   "result"    described at each function; null if there is an error
 *
 * The caller must free the returned text by contct_free. A function returns null if there is no memory for
 * an answer. Functions print nothing, throw nothing and write no files. They read a file only if the problem
 * names it (stiffness = "K.mtx").
 *
 * Any function may be called from any thread. Functions that call kernels wait for each other, because
 * COMMON /DOF/ and unit 26 of the 1989 code belong to the whole process. contct_check, contct_certify and
 * contct_exact without kernels do not wait.
 *
 * Options of all functions with a problem, each with its default:
 *   "file"    "problem": the name of the problem in messages and pages
 *   "folder"  "": the working directory. The folder of the problem, unless "file" begins with "/". The files
 *             that the problem names are searched there
 *   "allow_outside"
 *             false: a problem that names files outside its folder is refused, so that a problem from a
 *             stranger cannot read other files of the user. true: any file */
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

/* Formatting would join the lines of lists. */
/* clang-format off */

/* The version of this interface. It changes if any declaration in this file changes. */
#define CONTCT_SERVE_VERSION 1
CONTCT_SERVE_EXPORT int contct_serve_version(void);

/* "result": { "version": "0.2.0", "listing_sha256", "floating_point", "lapack", "kernels": [{ "name",
 *   "real_bytes", "rule", "language", "compiler", "flags" }], "engines": ["auto", ..] }. */
CONTCT_SERVE_EXPORT char* contct_about(void);

/* contct run: follows the path of a problem. "result" is what --json writes (reference/result-file.md).
 *   "kernels"         a list, the leader first. Without it "corrected" gives the answer, and the 1989 path is
 *                     compared with it
 *   "engine"          as --engine; without it, the default engine of the leader
 *   "final_only"      false; true: no path, only the equilibrium under the load of each step
 *   "envelope"        false; true: the result contains the envelope
 *   "max_increments"  0: the default limit
 *   "page", "log", "trace", "proof"
 *                     false; true: the answer contains the text that --html, --log, --trace or --proof
 *                     writes, under the same key
 *   "states"          false; true: the result also contains the structure and states within steps */
CONTCT_SERVE_EXPORT char* contct_run(const char* problem, const char* options);

/* contct check: reads a problem. "result": { "title", "kind": "beam" | "plate" | "matrix",
 *   "nodes", "dofs", "elements", "pairs", "steps": [names], "units": null or { "length", "force" },
 *   "x", "y": coordinates of every node of a plate; of a beam only "x" }.
 *   "places"  false; true: the result also contains "pair_list" and the place of each number in the text:
 *             "numbers": [{ "key": "contact[1].face", "value", "whole", "line", "column", "length" }] */
CONTCT_SERVE_EXPORT char* contct_check(const char* problem, const char* options);

/* contct exact: follows the path in rational arithmetic. "result" is what contct exact --json writes.
 *   "rule"     "corrected"; or "1989"
 *   "kernels"  kernels whose paths are compared with the exact path; without it, none */
CONTCT_SERVE_EXPORT char* contct_exact(const char* problem, const char* options);

/* contct explain: the effect of each line of the listing. "result" is what contct explain --json writes.
 *   "kernels"          ["fortran", "cpp"]; one or two kernels of the 1989 rule
 *   "engine"           "refactor"
 *   "step", "increment"  the number, from 1, of the only one to explain; without them, all are explained */
CONTCT_SERVE_EXPORT char* contct_explain(const char* problem, const char* options);

/* Bounds the errors of given states. "result" is that of contct_run without increments: `w`, `pairs`,
 * `error` and `certificate` of each state as it was given.
 *   "displacement"  [[..], ..]: a list of displacements at all dofs for each of the first steps, under the
 *                   full load of the step
 *   "closed"        [[..], ..]: for each of these states the pairs in contact, from 1. Without it, a pair is
 *                   in contact if the state touches or enters its face */
CONTCT_SERVE_EXPORT char* contct_certify(const char* problem, const char* options);

/* One call of a kernel: its name, followed by the arguments of contct_kernel (contct/kernel/plugin.h).
 * "result": { "text": what the call wrote to unit 26 }. A call whose id or dimensions lead outside the arrays
 * is refused. */
CONTCT_SERVE_EXPORT char* contct_call(const char* kernel, const double dd[], const double dtest[],
                                      const double cc[], double ss[], double* smin, const int id[],
                                      int isep[], const int isurf[], int nc, int indof, int ndofpn, int ndof);

/* A kernel of the caller, declared like contct_kernel of contct/kernel/plugin.h. It runs in this process. */
/* NOLINTNEXTLINE(modernize-use-using): this is C */
typedef void contct_kernel_function(const double dd[], const double dtest[], const double cc[], double ss[],
                                    double* smin, const int id[], int isep[], const int isurf[], int nc,
                                    int indof, int ndofpn, int ndof);

/* contct fuzz: sends random and adversarial calls and whole problems to a kernel of the caller, and compares
 * it with a leading kernel. "result" is what contct fuzz --json writes; "exit" is 1 if the two differ.
 *   "leader"  "fortran"
 *   "name"    "function": the name of the caller's kernel
 *   "calls"   20000; "problems" 40; "seed" 1989 */
CONTCT_SERVE_EXPORT char* contct_judge(contct_kernel_function* kernel, const char* options);

/* contct replay: sends the calls of a trace to a kernel. "result": { "kernel", "calls", "values_compared",
 *   "mismatches", "first": the first mismatch in words, or null }.
 *   "file"    "trace": the name of the trace in messages
 *   "kernel"  a kernel; without it "fortran", "fortran-r4" or "corrected", by the rule and precision of the
 *             trace */
CONTCT_SERVE_EXPORT char* contct_replay(const char* trace, const char* options);

/* Frees the text that one of these functions returned; null is allowed. */
CONTCT_SERVE_EXPORT void contct_free(char* text);

/* clang-format on */

#ifdef __cplusplus
}
#endif

#endif
