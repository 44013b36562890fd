#include "devices.hpp"

namespace sky::cli {

bool printDevices(const gl::HeadlessOptions& options, std::ostream& to)
{
    const std::vector<gl::DeviceInfo> devices = gl::listDevices(options);
    if (devices.empty()) {
        to << "EGL names no devices here. OSMesa, which has none to choose from, may still work: see calcmysky doctor." << std::endl;
        return false;
    }
    for (const gl::DeviceInfo& device : devices) {
        to << device.index << "  ";
        if (!device.problem.empty())
            to << (device.driver.empty() ? "unnamed device" : device.driver) << ": cannot be used: " << device.problem;
        else
            to << device.renderer << ", OpenGL " << device.version
               << (device.software         ? " (software: slow)"
                   : device.driver.empty() ? ""
                                           : ", " + device.driver);
        to << "\n";
    }
    to << std::flush;
    return true;
}

} // namespace sky::cli
