/* The calls of f2c's translation of the listing, and its unit 26. Only the descriptors of the listing's WRITE
 * statements are supported: X, I, E and text. Numbers are written as gfortran writes them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* clang-format off: f2c.h must be the last header, because it defines a macro abs */
#include <f2c.h>
/* clang-format on */

extern struct { integer indof, ndofpn; } dof_;

void contc8_(doublereal* dd, doublereal* dtest, doublereal* cc, doublereal* ss, doublereal* smin, integer* id,
             integer* isep, integer* isurf, integer* nc);
void contc4_(real* dd, real* dtest, real* cc, real* ss, real* smin, integer* id, integer* isep,
             integer* isurf, integer* nc);

void contct_call_r8(const double* dd, const double* dtest, const double* cc, double* ss, double* smin,
                    const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn) {
  dof_.indof = indof;
  dof_.ndofpn = ndofpn;
  contc8_((double*)dd, (double*)dtest, (double*)cc, ss, smin, (int*)id, isep, (int*)isurf, &nc);
}

void contct_call_r4(const float* dd, const float* dtest, const float* cc, float* ss, float* smin,
                    const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn) {
  dof_.indof = indof;
  dof_.ndofpn = ndofpn;
  contc4_((float*)dd, (float*)dtest, (float*)cc, ss, smin, (int*)id, isep, (int*)isurf, &nc);
}

/* Unit 26: a file, or NULL. */
static FILE* unit = NULL;

int contct_log_open(const char* path, int length) {
  char name[256];
  if (length < 0 || (size_t)length >= sizeof name) return 1;
  memcpy(name, path, (size_t)length);
  name[length] = 0;
  if (unit != NULL) fclose(unit);
  unit = fopen(name, "r+");
  return unit == NULL;
}

void contct_log_flush(void) {
  if (unit != NULL) fflush(unit);
}

void contct_log_rewind(void) {
  if (unit != NULL) rewind(unit);
}

void contct_log_close(void) {
  if (unit != NULL) fclose(unit);
  unit = NULL;
}

/* The current WRITE statement: the rest of its format, and its line so far. */
static struct {
  const char* at;
  char line[256];
  size_t length;
} now;

static void put(char c) {
  if (now.length < sizeof now.line) now.line[now.length++] = c;
}

static void put_right(const char* digits, size_t width) {
  const size_t length = strlen(digits);
  for (size_t i = 0; i < width; ++i)
    put(length > width ? '*' : i < width - length ? ' ' : digits[i - (width - length)]);
}

/* Copies text, which f2c quotes by \002, and blanks, up to the next descriptor of a number or the end. */
static void copy_text(void) {
  while (*now.at != 0 && *now.at != 'i' && *now.at != 'e') {
    if (*now.at == '\002') {
      while (*++now.at != '\002') put(*now.at);
      ++now.at;
    } else if (*now.at >= '0' && *now.at <= '9') {
      char* behind = NULL;
      for (long blanks = strtol(now.at, &behind, 10); blanks > 0; --blanks) put(' ');
      now.at = behind + 1; /* skips x */
    } else {
      ++now.at; /* skips a bracket or a comma */
    }
  }
}

/* Writes SMIN, which is positive, in the format Ew.d: 0.dddE+ee. snprintf rounds the digits. */
static void put_e(double x, size_t width, int digits) {
  char c[64], out[64];
  snprintf(c, sizeof c, "%.*e", digits - 1, x); /* d.dde+ee */
  const int exponent = atoi(strchr(c, 'e') + 1) + 1;
  snprintf(out, sizeof out, abs(exponent) > 99 ? "0.%c%.*s%+d" : "0.%c%.*sE%+03d", c[0], digits - 1, c + 2,
           exponent);
  put_right(out, width);
}

integer s_wsfe(cilist* control) {
  now.at = control->cifmt;
  now.length = 0;
  return 0;
}

integer do_fio(ftnint* count, char* value, ftnlen bytes) {
  copy_text();
  const char kind = *now.at;
  char* end = NULL;
  const size_t width = (size_t)strtol(now.at + 1, &end, 10);
  const int digits = *end == '.' ? (int)strtol(end + 1, &end, 10) : 0;
  now.at = end;
  (void)count; /* always 1 */
  if (kind == 'i') {
    char text[16];
    snprintf(text, sizeof text, "%d", *(const integer*)value);
    put_right(text, width);
  } else {
    put_e(bytes == sizeof(real) ? (double)*(const real*)value : *(const doublereal*)value, width, digits);
  }
  return 0;
}

integer e_wsfe(void) {
  copy_text();
  put('\n');
  if (unit != NULL) fwrite(now.line, 1, now.length, unit);
  return 0;
}
