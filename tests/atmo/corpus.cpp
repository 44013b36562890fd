// Malformed descriptions: tests/atmo/corpus/NAME.atmo, and in NAME.txt the whole message that a person gets for it.
#include <catch2/catch.hpp>

#include "atmo/parse.hpp"
#include "base/error.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

namespace {

const fs::path corpus = fs::path(SKY_TEST_DATA) / "corpus";

std::string content(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

// The message for a description, or nothing if it is accepted.
std::string messageFor(const fs::path& path)
{
    try {
        sky::atmo::parse(content(path), path.filename().string(), corpus);
    } catch (const sky::AtmoError& error) {
        std::string message = error.what();
        // The folder of the tests differs from machine to machine.
        const std::string folder = corpus.string() + "/";
        for (std::size_t at = message.find(folder); at != std::string::npos; at = message.find(folder))
            message.erase(at, folder.size());
        return message + "\n";
    }
    return {};
}

} // namespace

TEST_CASE("corpus: each malformed description gets its message")
{
    int count = 0;
    for (const auto& entry : fs::directory_iterator(corpus)) {
        if (entry.path().extension() != ".atmo" || entry.path().stem() == "valid")
            continue;
        ++count;
        INFO(entry.path().filename());
        const fs::path expected = fs::path(entry.path()).replace_extension(".txt");
        const std::string message = messageFor(entry.path());
        // SKY_UPDATE_CORPUS=1 writes the messages down; read the difference before committing it.
        if (std::getenv("SKY_UPDATE_CORPUS"))
            std::ofstream(expected, std::ios::binary) << message;
        CHECK_FALSE(message.empty());
        CHECK(message == content(expected));
    }
    CHECK(count > 90);
}

TEST_CASE("corpus: what the malformed descriptions were made from is accepted") { CHECK(messageFor(corpus / "valid.atmo").empty()); }

TEST_CASE("corpus: an error says that the input must change")
{
    try {
        sky::atmo::parse("version: 6\nversoin: 7\n", "x.atmo", {});
        FAIL("accepted");
    } catch (const sky::Error& error) {
        CHECK(error.inputMustChange());
    }
}
