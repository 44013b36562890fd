// The Sun behind drops with a diffraction peak: what is drawn there follows Sun and camera, and is what photometry says.
#include "showmysky/photometry.hpp"
#include "sky_for_tests.hpp"
#include <catch2/catch.hpp>

using namespace showmysky;
using namespace showmysky::testing;

TEST_CASE("aureole: pixels beside the Sun are what photometry says, wherever Sun and camera go", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky(SHOWMYSKY_DROPS, context.loader(), {});
    sky.loadAll();
    const Photometer photometer(SHOWMYSKY_DROPS);
    std::vector<double> radiance(photometer.wavelengthsNm().size());
    for (const auto& [altitude, zenithAngle] : {std::pair{0., 30.}, {0., 75.}, {5e3, 75.}}) { // above the cloud it is that of haze
        const auto settings = scene(altitude, zenithAngle);
        sky.setSettings(settings);
        for (const double aside : {0.6, 2., 5., 20.}) {
            const double view = (zenithAngle - aside) * degree;
            sky.draw({Projection::perspective, 0.01 * degree, settings.sun.azimuth, 90 * degree - view, 0}, 5, 5);
            photometer.radiance({altitude, settings.sun.zenithAngle, 0, view, 0}, Photometer::wholeSky, radiance.data());
            INFO("altitude " << altitude << ", Sun " << zenithAngle << ", " << aside << " degrees aside");
            CHECK(static_cast<double>(sky.readLuminance()[12].y) == Approx(photometer.colourOf(radiance.data()).Y).epsilon(0.01));
        }
    }
}
