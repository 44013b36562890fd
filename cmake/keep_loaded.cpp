// In sanitizer builds of a program with a window: libraries stay loaded until the end. Drivers that GLFW unloads would be unknown modules to
// the report of leaks, and cmake/lsan.supp goes by names. Visible, as our names are not by themselves: else GLFW would call libc's.
extern "C" __attribute__((visibility("default"))) int dlclose(void* library);
int dlclose(void*) { return 0; }
