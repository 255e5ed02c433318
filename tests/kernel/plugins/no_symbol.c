/* A library, but no kernel: it has only one of the two functions. */
int contct_kernel_abi(void);
int contct_kernel_abi(void) {
  return 1;
}
