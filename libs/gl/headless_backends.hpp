#pragma once
// Private to libs/gl: the two ways to a headless context. Each throws GlError with the reason when it can't make one.

#include "gl/context.hpp"

#if defined(__linux__) || defined(__FreeBSD__)
#define SKY_GL_HEADLESS 1
#else
#define SKY_GL_HEADLESS 0
#endif

namespace sky::gl {

std::unique_ptr<HeadlessImplementation> openEgl(const HeadlessOptions& options);
std::unique_ptr<HeadlessImplementation> openOsmesa(const HeadlessOptions& options);
std::vector<DeviceInfo> listEglDevices(const HeadlessOptions& options);

/// A shared library that stays loaded until the program ends: drivers do not survive being unloaded.
class DynamicLibrary
{
public:
    explicit DynamicLibrary(const std::string& name); ///< throws GlError with the system's reason
    void* find(const char* symbol) const;             ///< null where there is none
    /// throws GlError where the library lacks it
    template<class Function>
    Function need(const char* symbol) const
    {
        return reinterpret_cast<Function>(needAddress(symbol));
    }

private:
    void* needAddress(const char* symbol) const;
    std::string name_;
    void* handle_ = nullptr;
};

} // namespace sky::gl
