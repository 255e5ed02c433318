/* Functions for C that call f2c's translation of the listing and control libf2c's unit 26, as contct_c.f90
 * does for gfortran. All compilers' kernels share COMMON /DOF/, so the caller must serialise the calls. */
#include <f2c.h>

extern struct { integer indof, ndofpn; } dof_;

int f2c8_(doublereal* dd, doublereal* dtest, doublereal* cc, doublereal* ss, doublereal* smin, integer* id,
          integer* isep, integer* isurf, integer* nc);
integer f_open(olist*);
integer f_clos(cllist*);
integer f_rew(alist*);
int flush_(void);

enum { log_unit = 26 };
static int log_is_connected = 0;

/* Connects unit 26 to an existing file. Returns 0, or libf2c's error number. */
static int connect_log(const char* path, int length) {
  olist arguments = {0};
  arguments.oerr = 1; /* return an error instead of ending the program */
  arguments.ounit = log_unit;
  arguments.ofnm = (char*)path;
  arguments.ofnmlen = length;
  arguments.osta = "old";
  arguments.ofm = "formatted";
  const int status = f_open(&arguments);
  log_is_connected = status == 0;
  return status;
}

static void disconnect_log(void) {
  cllist arguments = {.cerr = 1, .cunit = log_unit, .csta = 0};
  if (log_is_connected) f_clos(&arguments);
  log_is_connected = 0;
}

/* Answers one call in double precision. The arguments are the listing's, then COMMON /DOF/. */
void contct_f2c_call_r8(const double* dd, const double* dtest, const double* cc, double* ss, double* smin,
                        const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn) {
  static const char nowhere[] = "/dev/null"; /* otherwise libf2c would create fort.26 */
  if (!log_is_connected) connect_log(nowhere, sizeof nowhere - 1);
  dof_.indof = indof;
  dof_.ndofpn = ndofpn;
  f2c8_((double*)dd, (double*)dtest, (double*)cc, ss, smin, (int*)id, isep, (int*)isurf, &nc);
}

int contct_f2c_log_open(const char* path, int length) {
  disconnect_log();
  return connect_log(path, length);
}

void contct_f2c_log_flush(void) {
  flush_();
}

void contct_f2c_log_rewind(void) {
  alist arguments = {.aerr = 1, .aunit = log_unit};
  f_rew(&arguments);
}

void contct_f2c_log_close(void) {
  disconnect_log();
}
