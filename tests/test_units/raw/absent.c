int stride_test_absent(void);
int stride_test_absent(void) { return 1; }
