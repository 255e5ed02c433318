/* A library that is no module of the program. */
int contct_something_else(void);
int contct_something_else(void) {
  return 1;
}
