// showmysky measure: how fast this machine draws a model, and what a picture costs.

#include "base/angles.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "gl/context.hpp"
#include "showmysky/sky.hpp"
#include "subcommand.hpp"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <functional>

namespace showmysky::app {

namespace {

using sky::base::pi;

double secondsOf(const std::function<void()>& action)
{
    const sky::base::Stopwatch watch;
    action();
    return watch.seconds();
}

class Measure : public Subcommand
{
public:
    CLI::App* addTo(CLI::App& app) override
    {
        auto* measure = app.add_subcommand("measure", "Time loading and drawing, 866 x 617 pixels, equirectangular");
        measure->add_option("MODEL", model_, "model directory")->required();
        measure->add_option("--seconds", seconds_, "for each figure")->capture_default_str()->check(CLI::Range(0.1, 600.));
        return measure;
    }

    int run() override
    {
        sky::gl::HeadlessOptions headless;
        headless.version = {3, 3, false};
        sky::gl::HeadlessContext context(headless);
        const auto finish = [&] { context.api()->Finish(); };
        std::printf("renderer                     %s\n", context.api().renderer().c_str());
        Sky sky(model_, context.loader());
        SceneSettings scene;
        Camera camera{Projection::equirectangular, 2 * pi, 0, 0, 0};
        const auto draw = [&] {
            sky.setSettings(scene);
            sky.draw(camera, 866, 617);
            finish();
        };
        std::printf("load to the first picture    %.3f s\n", secondsOf([&] {
                        sky.loadAll();
                        draw();
                    }));
        int frame = 0;
        const auto framesPerSecond = [&](const char* what, const std::function<void()>& change) {
            int frames = 0;
            double spent = 0;
            const std::clock_t before = std::clock();
            while (spent < seconds_) {
                spent += secondsOf([&] {
                    change();
                    draw();
                });
                ++frames;
                ++frame;
            }
            const double processor = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
            std::printf("%-32s %.1f frames/s, %.0f ms of processor time each\n", what, frames / spent, 1e3 * processor / frames);
        };
        framesPerSecond("camera turning", [&] { camera.yaw = 0.001 * frame; });
        std::printf("texture fetches per pixel    %d\n", sky.fetchesPerPixel());
        framesPerSecond("Sun moving", [&] { scene.sun.zenithAngle = 1 + 0.0005 * frame; });
        framesPerSecond("altitude moving", [&] { scene.altitude = 10. * frame; });
        scene = {};
        scene.eclipse = EclipseMode::on;
        scene.sun.zenithAngle = 0.8;
        const auto moveMoon = [&] { scene.moon = {0.00005 * (frame % 100), 0.8, 371925e3}; };
        scene.eclipseOrders = 2;
        moveMoon();
        draw(); // what a model and a Sun need once
        framesPerSecond("eclipse of order 2, Moon moving", moveMoon);
        scene.eclipseOrders = 0;
        framesPerSecond("eclipse, all orders, Moon moving", moveMoon);
        scene.layers.multipleScattering = scene.layers.zeroOrder = false;
        framesPerSecond("eclipse of order 1, Moon moving", moveMoon);
        scene = {};
        scene.layers.lightPollution = true;
        scene.cities = {{30e3, 0.5, 8e3, 1, std::vector<double>(sky.wavelengths().size(), 1.)}};
        scene.sun.zenithAngle = 2;
        const auto once = [&](const char* what) {
            const std::clock_t before = std::clock();
            const double spent = secondsOf(draw);
            std::printf("%-32s %.2f s, %.2f s of processor time\n", what, spent,
                        static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
        };
        once("city of a new radius");
        scene.cities[0].distance = 31e3;
        once("city of that radius elsewhere");
        framesPerSecond("city, camera turning", [&] { camera.yaw = 0.001 * frame; });
        scene = {};
        if (sky.hasSource(Source::textures)) {
            scene.source = Source::textures;
            scene.altitude = 0;
            framesPerSecond("textures: Sun moving", [&] { scene.sun.zenithAngle = 1 + 0.0005 * frame; });
            framesPerSecond("textures: altitude moving", [&] { scene.altitude = 10. * frame; });
        }
        std::printf("textures on the GPU          %.1f MB\n", static_cast<double>(sky.textureBytes()) / 1e6);
        return 0;
    }

private:
    std::string model_;
    double seconds_ = 2;
};

} // namespace

std::unique_ptr<Subcommand> makeMeasure() { return std::make_unique<Measure>(); }

} // namespace showmysky::app
