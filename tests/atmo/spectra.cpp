// Spectra in files: the table's form, and how it is brought to the wavelengths of the description.
#include <catch2/catch.hpp>

#include "atmo/tabulated_spectrum.hpp"
#include "base/error.hpp"
#include "sample.hpp"

#include <filesystem>
#include <fstream>
#include <random>

using namespace sky::atmo;
using Catch::Matchers::Contains;

namespace {

TabulatedSpectrum table(const std::string& text) { return TabulatedSpectrum(Source(text, "table.csv")); }

// The ground albedo of the sample (400, 500, 600, 700 nm) when given as `value`.
Spectrum albedo(const std::string& value, const ParseOptions& options = {})
{
    return sample::parse(sample::with("ground albedo: 0.1, 0.2, 0.3, 0.4", "ground albedo: " + value), options).groundAlbedo;
}

// A folder for files that a test writes, removed at its end.
struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / ("sky-atmo-" + std::to_string(std::random_device()()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path / name, std::ios::binary) << text; }
};

void checkEqual(const Spectrum& values, const Spectrum& expected)
{
    REQUIRE(values.size() == expected.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        CHECK(values[i] == Approx(expected[i]).epsilon(1e-14)); // a few roundings
}

} // namespace

TEST_CASE("spectrum files: comments, empty lines, CRLF, blanks and falling wavelengths")
{
    for (const char* text : {"400,1\n500,3\n", "# c\r\n\r\n 400 , 1 # one\r\n500,3", "500,3\n400,1\n",
                             "\xEF\xBB\xBF"
                             "4e2,+1\n\n5e2,3"}) {
        INFO(text);
        const TabulatedSpectrum spectrum = table(text);
        CHECK(spectrum.firstNm() == 400);
        CHECK(spectrum.lastNm() == 500);
        CHECK(spectrum.at(450) == 2);
    }
    CHECK_THROWS_WITH(table("400,1\n400,1\n"), Contains("table.csv:2:1") && Contains("out of order"));
    CHECK_THROWS_WITH(table("500,1\n400,1\n450,1\n"), Contains("table.csv:3:1"));
    CHECK_THROWS_WITH(table("400,1\n500,1\n450,1\n"), Contains("table.csv:3:1"));
    CHECK_THROWS_WITH(table("400;1\n"), Contains("expected `,`"));
    CHECK_THROWS_WITH(table("400,nan\n"), Contains("expected a number"));
}

TEST_CASE("spectrum files: values between points and beyond the ends")
{
    const TabulatedSpectrum spectrum = table("400,1\n410,3\n450,2\n");
    CHECK(spectrum.at(400) == 1);
    CHECK(spectrum.at(405) == 2);
    CHECK(spectrum.at(410) == 3);
    CHECK(spectrum.at(430) == 2.5);
    CHECK(spectrum.at(300) == 1);
    CHECK(spectrum.at(500) == 2);
    CHECK(table("550,7\n").at(550) == 7);
}

TEST_CASE("band average: closed forms")
{
    // Triangle of height 1 over 400..500: mean over +-50 is 1/2, over +-25 is 3/4.
    const TabulatedSpectrum triangle = table("300,0\n400,0\n450,1\n500,0\n600,0\n");
    CHECK(triangle.bandMean(450, 50) == Approx(0.5));
    CHECK(triangle.bandMean(450, 25) == Approx(0.75));
    CHECK(triangle.bandMean(450, 100) == Approx(0.25));
    CHECK(triangle.bandMean(450, 0) == 1);
    // Clipped to the table: at its end half of the band is left.
    CHECK(table("400,0\n500,1\n").bandMean(400, 50) == Approx(0.25));
    CHECK(table("400,0\n500,1\n").bandMean(500, 1000) == Approx(0.5));
    CHECK(table("550,7\n").bandMean(550, 10) == 7);
}

TEST_CASE("band average: a table coarser than the grid is interpolated")
{
    const TabulatedSpectrum line = table("300,0\n900,6\n");
    for (const double nm : {400.0, 550.0, 830.0})
        CHECK(line.bandMean(nm, 10) == Approx(line.at(nm)).epsilon(1e-14));
}

TEST_CASE("band average: energy is kept where bands meet without gap")
{
    std::string text;
    double value = 0.37, integral = 0;
    for (int nm = 350; nm <= 750; ++nm) {
        value = 3.9 * value * (1 - value); // anything rough
        integral += value * (nm == 350 || nm == 750 ? 0.5 : 1);
        text += std::to_string(nm) + "," + std::to_string(value) + "\n";
    }
    const TabulatedSpectrum rough = table(text);
    double sum = 0;
    for (const double nm : {400.0, 500.0, 600.0, 700.0})
        sum += 100 * rough.bandMean(nm, 50);
    CHECK(sum == Approx(integral).epsilon(1e-5)); // std::to_string keeps six decimals
}

TEST_CASE("spectrum entries: file, options of the file and of the parser")
{
    const Folder folder;
    folder.write("line.csv", "300,0\n450,0.6\n600,0\n");
    const std::string file = "file \"" + (folder.path / "line.csv").string() + "\"";
    // Bands of +-50 nm; at 400 linear; the last wavelength, 700 nm, is outside of the file.
    CHECK_THROWS_WITH(albedo(file), Contains("covers 300 to 600 nm, but 700 nm"));
    const double kink = (0.5 * (0.4 + 0.6) * 0 + 0.5 * (0.6 + 0.2) * 100) / 100, end = 0.5 * (0.2 + 0.0);
    checkEqual(albedo(file + " [outside=zero]"), {0.4, kink, end, 0});
    checkEqual(albedo(file + " [ Outside = end , resample = point ]"), {0.4, 0.4, 0, 0});
    checkEqual(albedo(file, {Resampling::Point, OutsideRange::Zero}), {0.4, 0.4, 0, 0});
    checkEqual(albedo(file + "[resample=band]", {Resampling::Point, OutsideRange::Zero}), {0.4, kink, end, 0});
    CHECK_THROWS(albedo(file + " [outside=error]", {Resampling::Point, OutsideRange::Zero}));

    folder.write("high.csv", "450,0.25\n1000,0.75\n");
    const std::string high = "file " + (folder.path / "high.csv").string();
    CHECK(albedo(high + " [outside=end]")[0] == 0.25);
    CHECK(albedo(high + " [outside=zero]")[0] == 0);
}

TEST_CASE("spectrum entries: weighted files add up, relative to the description")
{
    const Folder folder;
    std::filesystem::create_directory(folder.path / "my spectra");
    folder.write("my spectra/grass #1.csv", "300,0.5\n800,0.5\n");
    folder.write("my spectra/snow.csv", "300,1\n800,1\n");
    folder.write("test.atmo", sample::with("ground albedo: 0.1, 0.2, 0.3, 0.4",
                                           "ground albedo: Weighted file 0.8 \"my spectra/grass #1.csv\" # quoted, for its #\n"
                                           "ground albedo: weighted file 2e-1 my spectra/snow.csv # blanks need no quotes"));
    checkEqual(parseFile(folder.path / "test.atmo").groundAlbedo, {0.6, 0.6, 0.6, 0.6});
}

TEST_CASE("spectrum entries: rounding does not push a white surface over one")
{
    const std::string flat = "weighted file 0.1 spectra/white.csv\nground albedo: ";
    const Folder folder;
    std::filesystem::create_directory(folder.path / "spectra");
    folder.write("spectra/white.csv", "300,1\n800,1\n");
    std::string value;
    for (int i = 0; i < 9; ++i)
        value += flat;
    value += "weighted file 0.10000000000000003 spectra/white.csv";
    folder.write("test.atmo", sample::with("0.1, 0.2, 0.3, 0.4", value));
    CHECK(parseFile(folder.path / "test.atmo").groundAlbedo == Spectrum(4, 1.0));
}

TEST_CASE("spectrum entries: one wavelength takes the point, whatever the rule")
{
    std::string text = sample::with("min=400nm, max=700nm, count=4", "min=550nm, max=550nm, count=1");
    text = sample::with("1.5, 1.9, 1.8, 1.4", "1.9", text);
    text = sample::with("0.1, 0.2, 0.3, 0.4", "file spectra/flat.csv", text);
    text = sample::with("1e-27, 1e-25, 4e-25, 2e-26", "1e-25", text);
    CHECK(sample::parse(text).groundAlbedo == Spectrum{0.2});
}

TEST_CASE("descriptions: a file that is missing or too large is refused")
{
    const Folder folder;
    CHECK_THROWS_AS(parseFile(folder.path / "none.atmo"), sky::FileError);
    CHECK_THROWS_AS(parseFile(folder.path), sky::FileError);
    folder.write("big.atmo", "");
    std::filesystem::resize_file(folder.path / "big.atmo", 17u << 20);
    CHECK_THROWS_AS(parseFile(folder.path / "big.atmo"), sky::FileError);
    folder.write("big.csv", "");
    std::filesystem::resize_file(folder.path / "big.csv", 65u << 20);
    CHECK_THROWS_AS(albedo("file " + (folder.path / "big.csv").string()), sky::AtmoError);
}
