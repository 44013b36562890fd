#include "gl/headless_backends.hpp"

#if SKY_GL_HEADLESS

#include <dlfcn.h>

#include "base/error.hpp"

namespace sky::gl {

DynamicLibrary::DynamicLibrary(const std::string& name) : name_(name), handle_(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL))
{
    if (!handle_) {
        const char* reason = dlerror();
        throw GlError(name + " can't be loaded: " + (reason ? reason : "unknown reason"));
    }
}

void* DynamicLibrary::find(const char* symbol) const { return dlsym(handle_, symbol); }

void* DynamicLibrary::needAddress(const char* symbol) const
{
    void* address = find(symbol);
    if (!address)
        throw GlError(name_ + " has no function " + symbol);
    return address;
}

} // namespace sky::gl

#endif
