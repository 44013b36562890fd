// --max-memory: the same tables from work that is split.
#include "support.hpp"

using namespace sky::solver;
using namespace sky::solver::test;

TEST_CASE("memory: a bound splits the work and changes no value", "[gl]")
{
    auto context = sky::gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.species = SceneText::rayleigh() + SceneText::dust();
    scene.views = "32", scene.azimuths = "16", scene.suns = "32";
    for (const bool radiance : {false, true}) {
        CAPTURE(radiance);
        Options options = draft();
        options.radiance = radiance;
        const Run whole(*context, scene.parse(), options);
        for (const std::size_t bytes : {std::size_t(1), (std::size_t(130) << 20) + (160 << 10)}) { // one view at a time, and some
            CAPTURE(bytes);
            options.maxMemoryBytes = bytes;
            const Run split(*context, scene.parse(), options);
            for (const auto& table : whole.model.tables()) {
                CAPTURE(table.name);
                CHECK(split.model.readAll(table.name) == whole.model.readAll(table.name));
            }
        }
    }
}
