/* A module of another version of the program. */
const char* contct_petsc_version(void);
void* contct_petsc_join(void);
const char* contct_petsc_version(void) {
  return "0.0.1";
}
void* contct_petsc_join(void) {
  return 0;
}
