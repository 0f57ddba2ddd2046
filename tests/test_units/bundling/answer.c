int stride_test_answer(void);
int stride_test_answer(void) { return 42; }
