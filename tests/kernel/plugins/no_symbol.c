/* A library without the function contct_kernel. */
int contct_kernel_abi(void);
int contct_kernel_abi(void) {
  return 1;
}
