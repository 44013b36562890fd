// Damaged, foreign and hostile models: each gives its sentence, none crashes.
#include "base/error.hpp"
#include "model/exr_header.hpp"
#include "support.hpp"
#include <catch2/catch.hpp>
#include <functional>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

using namespace sky;
using namespace sky::model;
using namespace sky::model::test;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

std::string smallManifestText()
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    return readFile(scratch.path / "m" / "manifest.json");
}

std::string messageOf(const std::function<void()>& action)
{
    try {
        action();
    } catch (const ModelError& error) {
        return error.what();
    }
    return "no error";
}

struct Change {
    const char* name;
    std::function<void(Json&)> apply;
    const char* expected;
};

/// Puts a value into all channels of a texel of an image of floats, as another program might.
void spoilTexel(const fs::path& file, const int row, const int column, const float value)
{
    std::optional<Imf::InputFile> in(std::in_place, file.c_str());
    const Imf::Header header = in->header();
    const auto box = header.dataWindow();
    const int width = box.max.x + 1, height = box.max.y + 1;
    std::map<std::string, std::vector<float>> images;
    Imf::FrameBuffer frame;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        auto& image = images[channel.name()];
        image.resize(static_cast<std::size_t>(width) * height);
        frame.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(image.data()), sizeof(float), sizeof(float) * width));
    }
    in->setFrameBuffer(frame);
    in->readPixels(0, height - 1);
    in.reset();
    for (auto& [name, image] : images)
        image[static_cast<std::size_t>(row) * width + column] = value;
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(frame);
    out.writePixels(height);
}

// Whatever is read from it, a broken model gives its values or a ModelError.
void readEverything(const fs::path& directory)
{
    try {
        const Model model = Model::open(directory);
        for (const Table& table : model.tables()) {
            try {
                const auto values = model.readAll(table.name);
                CHECK(values.size() == table.valueCount(table.rows()));
            } catch (const ModelError&) {
            }
        }
    } catch (const ModelError&) {
    }
}

} // namespace

TEST_CASE("a broken manifest: the sentence names the entry and what was expected")
{
    const std::vector<Change> changes{
        {"no format", [](Json& j) { j.erase("format"); }, "x: this is not the manifest of a sky model"},
        {"foreign format", [](Json& j) { j["format"] = "holiday pictures"; }, "this is not the manifest of a sky model"},
        {"future", [](Json& j) { j["formatVersion"] = 2; }, "the model has format version 2, this program reads version 1"},
        {"missing", [](Json& j) { j.erase("planetRadius"); }, "x: the entry 'planetRadius' is missing."},
        {"text for number", [](Json& j) { j["planetRadius"] = "6371 km"; }, "planetRadius: expected a number, found string."},
        {"flat planet", [](Json& j) { j["planetRadius"] = 0; }, "planetRadius: is 0.0; 0.001 to 1e+20 is expected."},
        {"no wavelengths", [](Json& j) { j["wavelengthsNm"] = Json::array(); }, "wavelengthsNm: has 0 values"},
        {"wavelengths fall",
         [](Json& j) {
             j["wavelengthsNm"] = {4, 3, 2, 1};
         },
         "wavelengthsNm: must increase"},
        {"short spectrum", [](Json& j) { j["groundAlbedo"] = {0.5}; }, "groundAlbedo: has 1 values; one for each of the 4"},
        {"bright ground", [](Json& j) { j["groundAlbedo"][2] = 1.5; }, "groundAlbedo[2]: is 1.5; 0.0 to 1.0 is expected."},
        {"null in a spectrum", [](Json& j) { j["solarIrradiance"][1] = nullptr; }, "solarIrradiance[1]: expected a number, found null"},
        {"orders", [](Json& j) { j["scatteringOrders"] = 1.5; }, "scatteringOrders: expected an integer"},
        {"huge integer", [](Json& j) { j["scatteringOrders"] = 18446744073709551615ull; }, "scatteringOrders: is 18446744073709551615"},
        {"species", [](Json& j) { j["species"][0]["phaseFunctionType"] = "odd"; }, "species[0].phaseFunctionType: is 'odd'"},
        {"tables", [](Json& j) { j["tables"] = 3; }, "tables: expected an array, found number."},
        {"escape upwards", [](Json& j) { j["tables"][0]["file"] = "../../etc/passwd"; },
         "tables[0].file: is '../../etc/passwd'; a plain relative name"},
        {"absolute path", [](Json& j) { j["tables"][0]["file"] = "/etc/passwd"; }, "a plain relative name"},
        {"backslash", [](Json& j) { j["tables"][0]["file"] = "..\\x.exr"; }, "a plain relative name"},
        {"hidden", [](Json& j) { j["tables"][0]["file"] = "a/.b"; }, "a plain relative name"},
        {"file in files", [](Json& j) { j["files"]["../x"] = j["files"]["radiance.exr"]; }, "is not a plain relative name"},
        {"unlisted", [](Json& j) { j["files"].erase("radiance.exr"); },
         "tables[0].file: the file 'radiance.exr' of table 'radiance' is not listed"},
        {"checksum", [](Json& j) { j["files"]["radiance.exr"]["xxh3-128"] = "12"; }, "32 hexadecimal digits"},
        {"negative size", [](Json& j) { j["files"]["radiance.exr"]["bytes"] = -1; }, "files.radiance.exr.bytes: is -1; 0 to"},
        {"twice", [](Json& j) { j["tables"][1] = j["tables"][0]; }, "two tables are called 'radiance'"},
        {"no axes", [](Json& j) { j["tables"][0]["axes"] = Json::array(); }, "1 to 8 axes are expected, not 0."},
        {"no nodes", [](Json& j) { j["tables"][0]["axes"][1]["nodes"] = Json::array(); }, "axis 'sunZenithAngle' has no nodes."},
        {"row axes", [](Json& j) { j["tables"][0]["rowAxes"] = 5; }, "rowAxes is 5, expected 1 to the number of axes."},
        {"channel names", [](Json& j) { j["tables"][0]["channelNames"][0] = "S0.1nm"; }, "channelNames: does not agree"},
        {"exponents", [](Json& j) { j["tables"][1]["rowExponents"] = {1}; }, "rowExponents: has 1 values; one for each of the 128 rows"},
        {"wild exponent", [](Json& j) { j["tables"][1]["rowExponents"][3] = 1e9; }, "rowExponents[3]: expected an integer"},
        {"storage", [](Json& j) { j["tables"][1]["storage"] = "double"; }, "storage: is 'double'; half or float is expected."},
    };
    const Json good = Json::parse(smallManifestText());
    CHECK(parseManifest(good.dump(), "x").tables.size() == 2);
    for (const Change& change : changes) {
        Json bad = good;
        change.apply(bad);
        INFO(change.name);
        CHECK_THAT(messageOf([&] { parseManifest(bad.dump(), "x"); }), Catch::Contains(change.expected));
    }
}

TEST_CASE("a manifest that is no JSON, or nested without end")
{
    CHECK_THAT(messageOf([] { parseManifest("", "m/manifest.json"); }), Catch::StartsWith("m/manifest.json: not valid JSON"));
    CHECK_THAT(messageOf([] { parseManifest("{\"a\": 1e999}", "x"); }), Catch::Contains("not valid JSON"));
    CHECK_THAT(messageOf([] { parseManifest(std::string(1000000, '['), "x"); }), Catch::StartsWith("x: "));
    CHECK_THAT(messageOf([] { parseManifest(std::string(50, '[') + std::string(50, ']'), "x"); }),
               Catch::Contains("more than 16 nested levels"));
    CHECK_THAT(messageOf([] { parseManifest("[1, 2]", "x"); }), Catch::Contains("not the manifest of a sky model"));
}

TEST_CASE("axes that multiply to more than memory are refused before anything is allocated")
{
    Json j = Json::parse(smallManifestText());
    const Json nodes(std::vector<int>(5000, 0));
    for (int i = 0; i < 4; ++i)
        j["tables"][0]["axes"][static_cast<std::size_t>(i)]["nodes"] = nodes;
    CHECK_THAT(messageOf([&] { parseManifest(j.dump(), "x"); }), Catch::Contains("more than 2^24 rows or columns"));
}

TEST_CASE("a directory that isn't a whole model")
{
    const Scratch scratch;
    const fs::path m = scratch.path / "m";
    const auto open = [&] { return messageOf([&] { Model::open(m); }); };
    CHECK_THAT(open(), Catch::StartsWith("There is no model directory"));
    fs::create_directory(m);
    CHECK_THAT(open(), Catch::Contains("is not a model: it has no manifest.json."));
    fs::remove(m);
    writeSmallModel(m);
    fs::rename(m / "radiance.exr", scratch.path / "elsewhere.exr");
    CHECK_THAT(open(), Catch::Contains("radiance.exr' is missing"));
    fs::create_symlink(scratch.path / "elsewhere.exr", m / "radiance.exr");
    CHECK_THAT(open(), Catch::Contains("radiance.exr' is a link"));
    fs::remove(m / "radiance.exr");
    writeFile(m / "radiance.exr", readFile(scratch.path / "elsewhere.exr") + " ");
    CHECK_THAT(open(), Catch::Contains("bytes, the manifest says"));
}

TEST_CASE("a file of the right size but other content is found by its checksum")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    const fs::path file = scratch.path / "m" / "description.atmo";
    writeFile(file, "version: 7\n");
    const Model model = Model::open(scratch.path / "m");
    CHECK_THROWS_WITH(model.verifyChecksums(), Catch::Contains("description.atmo' is damaged"));
    writeFile(file, "version: 6\n");
    CHECK_NOTHROW(model.verifyChecksums());
}

TEST_CASE("EXR headers that don't agree with the manifest are refused before OpenEXR sees them")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    const Model model = Model::open(scratch.path / "m");
    const Table& table = model.table("radiance");
    const std::string good = readFile(scratch.path / "m" / "radiance.exr");
    const auto check = [&](const std::string& bytes, const Table& as) {
        return messageOf([&] {
            std::istringstream stream(bytes);
            checkExrHeader(stream, bytes.size(), as, "f");
        });
    };
    const auto edited = [&](const std::string& after, std::size_t skip, const std::string& bytes) {
        std::string text = good;
        return text.replace(text.find(after) + after.size() + skip, bytes.size(), bytes);
    };
    using namespace std::string_literals;
    const std::string huge = "\xff\xff\xff\x7f";
    CHECK(check(good, table) == "no error");
    CHECK(check("", table) == "f: not an OpenEXR file.");
    CHECK(check("P6 1 1 255 rgb", table) == "f: not an OpenEXR file.");
    CHECK_THAT(check(good.substr(0, 100), table), Catch::Contains("cut off"));
    CHECK_THAT(check(edited("dataWindow\0box2i\0\x10\0\0\0"s, 8, huge), table),
               Catch::Contains("does not have 18 x 128 texels as the manifest says"));
    CHECK_THAT(check(edited("table\0string\0"s, 0, huge), table), Catch::Contains("cut off or longer than 1 MiB"));
    CHECK_THAT(check(edited("compression\0compression\0\x01\0\0\0"s, 0, "\x08"), table),
               Catch::Contains("compressed by a method that this format does not use"));
    CHECK_THAT(check(edited("S0.500nm\0"s, 0, "\x01"), table), Catch::Contains("'S0.500nm' does not hold floats"));
    CHECK_THAT(check(edited("S0.500nm\0"s, 8, "\x02"), table), Catch::Contains("'S0.500nm' is subsampled"));
    CHECK_THAT(check(edited("S0.50", 0, "1"), table), Catch::Contains("'S0.501nm' that the manifest does not name"));
    CHECK_THAT(check(edited("quantity\0"s, 0, "previe"), table), Catch::Contains("the type 'previe'"));
    std::string tiled = good;
    tiled[5] |= 0x02;
    CHECK_THAT(check(tiled, table), Catch::Contains("one scanline image is expected"));
}

TEST_CASE("truncated images and manifests of any length give an error, never a crash")
{
    const Scratch scratch;
    const fs::path m = scratch.path / "m";
    writeSmallModel(m);
    for (const char* file : {"radiance.exr", "layers/luminance.exr"}) {
        const std::string whole = readFile(m / file);
        const std::string manifest = readFile(m / "manifest.json");
        const std::string sizeBefore = "\"" + std::string(file) + "\": {\n      \"bytes\": ";
        for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 97) {
            writeFile(m / file, whole.substr(0, length));
            std::string lying = manifest; // that the size agrees lets the damage through to the image reader
            lying.replace(lying.find(sizeBefore) + sizeBefore.size(), std::to_string(whole.size()).size(), std::to_string(length));
            writeFile(m / "manifest.json", lying);
            const std::string name = std::string(file).substr(0, std::string(file).size() - 4);
            INFO(name << " cut to " << length);
            CHECK_THAT(messageOf([&] { Model::open(m).readAll(name); }), Catch::Contains(file));
        }
        writeFile(m / file, whole);
        writeFile(m / "manifest.json", manifest);
    }
    const std::string manifest = readFile(m / "manifest.json");
    for (std::size_t length = 0; length + 2 < manifest.size(); length += 61)
        CHECK_THAT(messageOf([&] { parseManifest(manifest.substr(0, length), "x"); }), Catch::Contains("not valid JSON"));
}

TEST_CASE("an image with a value that is no radiance is refused with its row")
{
    const float limit = std::numeric_limits<float>::infinity();
    for (const auto& [value, said] : {std::pair{std::numeric_limits<float>::quiet_NaN(), "row 3 is not finite"},
                                      {limit, "row 3 is not finite"},
                                      {-1.f, "row 3 is negative"}}) {
        const Scratch scratch;
        const fs::path m = scratch.path / "m", file = m / "radiance.exr";
        writeSmallModel(m);
        const std::string before = "\"radiance.exr\": {\n      \"bytes\": " + std::to_string(fs::file_size(file));
        spoilTexel(file, 3, 1, value);
        std::string manifest = readFile(m / "manifest.json");
        const std::size_t at = manifest.find(before);
        REQUIRE(at != std::string::npos);
        manifest.replace(at, before.size(), "\"radiance.exr\": {\n      \"bytes\": " + std::to_string(fs::file_size(file)));
        writeFile(m / "manifest.json", manifest);
        CHECK_THAT(messageOf([&] { Model::open(m).readAll("radiance"); }), Catch::Contains("radiance.exr") && Catch::Contains(said));
        CHECK(messageOf([&] { Model::open(m).readRows("radiance", 4, 2); }) == "no error"); // the damage is in one row alone
    }
}

TEST_CASE("random damage never crashes the reader")
{
    const Scratch scratch;
    const fs::path m = scratch.path / "m";
    writeSmallModel(m);
    std::mt19937 random(20240607);
    for (const char* file : {"radiance.exr", "layers/luminance.exr", "manifest.json"}) {
        const std::string whole = readFile(m / file);
        // The first 1500 bytes hold the header and the offsets of an image: most flips go there.
        for (int round = 0; round < 250; ++round) {
            std::string bad = whole;
            const std::size_t span = round % 4 ? std::min<std::size_t>(1500, bad.size()) : bad.size();
            for (unsigned flips = 1 + random() % 4; flips > 0; --flips)
                bad[random() % span] = static_cast<char>(random());
            writeFile(m / file, bad);
            readEverything(m);
        }
        writeFile(m / file, whole);
    }
    CHECK_NOTHROW(Model::open(m).verifyChecksums()); // all is as it was
}
