// In sanitizer builds of a program with a window: libraries stay loaded until the end. Drivers that GLFW unloads would be unknown modules to
// the report of leaks, and cmake/lsan.supp goes by names.
extern "C" int dlclose(void* library);
extern "C" int dlclose(void*) { return 0; }
