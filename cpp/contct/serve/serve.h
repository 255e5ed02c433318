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
 *   "folder"  "": the folder of the problem, unless "file" begins with "/"; files that the problem names are
 *             searched in this folder. "" is the working directory
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

/* Describes the program. "result": { "version": "0.2.0", "listing_sha256", "floating_point", "lapack",
 *   "kernels": [{ "name", "real_bytes", "rule", "language", "compiler", "flags" }],
 *   "engines": ["auto", ..] }. */
CONTCT_SERVE_EXPORT char* contct_about(void);

/* contct run: follows the path of a problem. "result" is what --json writes (reference/result-file.md).
 *   "kernels"         a list, the leader first. Without a list, the kernel "corrected" gives the answer, and
 *                     the 1989 path is compared with the answer
 *   "engine"          as --engine; without this option, the default engine of the leader
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
 *   "kernels"  kernels whose paths are compared with the exact path; without this option, none */
CONTCT_SERVE_EXPORT char* contct_exact(const char* problem, const char* options);

/* contct explain: explains the lines of the listing. "result" is what contct explain --json writes.
 *   "kernels"          ["fortran", "cpp"]; one or two kernels of the 1989 rule
 *   "engine"           "refactor"
 *   "step", "increment"  the only step, and the only increment in a step, to explain, from 1; default: all */
CONTCT_SERVE_EXPORT char* contct_explain(const char* problem, const char* options);

/* Bounds the errors of given states. "result" is that of contct_run without increments: `w`, `pairs`,
 * `error` and `certificate` of each state as it was given.
 *   "displacement"  [[..], ..]: a list of displacements at all dofs for each of the first steps, under the
 *                   full load of the step
 *   "closed"        [[..], ..]: for each state the pairs in contact, from 1. Without this option, a pair is
 *                   in contact if the structure touches its face or is beyond it */
CONTCT_SERVE_EXPORT char* contct_certify(const char* problem, const char* options);

/* Calls a kernel once. `kernel` is its name; the other arguments are those of contct_kernel
 * (contct/kernel/plugin.h). "result": { "text": what the call wrote to unit 26 }. A call whose id, indof or
 * ndofpn leads outside the arrays is refused. */
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
 *   "calls"   20000; "problems" 40; "seed" 1989: as --calls, --problems and --seed of contct fuzz */
CONTCT_SERVE_EXPORT char* contct_judge(contct_kernel_function* kernel, const char* options);

/* contct replay: sends the calls of a trace to a kernel. "result": { "kernel", "calls", "values_compared",
 *   "mismatches", "first": the first mismatch in words, or null }.
 *   "file"    "trace": the name of the trace in messages
 *   "kernel"  a kernel; without this option "fortran", "fortran-r4" or "corrected", by the rule and precision
 *             of the trace */
CONTCT_SERVE_EXPORT char* contct_replay(const char* trace, const char* options);

/* Frees a text that a function of this file returned; null is allowed. */
CONTCT_SERVE_EXPORT void contct_free(char* text);

/* clang-format on */

#ifdef __cplusplus
}
#endif

#endif
