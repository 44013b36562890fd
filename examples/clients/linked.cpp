// A C++ program that links the library: prints the luminance of the zenith while the Sun sets.
//     linked MODEL

#include "context.h"
#include <cstdio>
#include <showmysky/sky.hpp>

int main(int argc, char** argv)
{
    if (argc != 2)
        return std::puts("usage: linked MODEL"), 2;
    if (!make_context())
        return std::puts("no OpenGL 3.3 context"), 77;
    try {
        showmysky::Sky sky(argv[1], [](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); });
        for (auto progress = sky.loadStep(); !progress.done; progress = sky.loadStep())
            std::printf("%3.0f %%  %s\n", 100 * progress.fraction, progress.activity.c_str());
        showmysky::Camera up;
        up.pitch = 1.5707963268;
        float before = 1e9f;
        for (int zenithDeg = 30; zenithDeg <= 95; zenithDeg += 13) {
            showmysky::SceneSettings scene;
            scene.sun.zenithAngle = zenithDeg * 3.14159265358979 / 180;
            sky.setSettings(scene);
            sky.draw(up, 64, 64);
            const float now = sky.pixelLuminance(32, 32).y;
            std::printf("Sun %2d degrees from the zenith: %10.3f cd/m^2\n", zenithDeg, static_cast<double>(now));
            if (!(now > 0 && now < before))
                return 1;
            before = now;
        }
    } catch (const showmysky::Error& error) {
        std::printf("%s\n", error.what());
        return 1;
    }
}
