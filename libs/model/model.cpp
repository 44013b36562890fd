#include "model/model.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "model/checksum.hpp"
#include "model/exr_header.hpp"
#include "model/precision.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfIO.h>

namespace sky::model {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t maxManifestBytes = 64 << 20, maxTextBytes = 64 << 20;

// One handle for our check of the header and for OpenEXR: what was checked is what is read.
class Stream : public Imf::IStream
{
public:
    Stream(const fs::path& path, std::uint64_t bytes) : Imf::IStream(path.string().c_str()), file_(path, std::ios::binary), bytes_(bytes) {}
    std::ifstream& file() { return file_; }
    bool read(char buffer[], int count) override
    {
        if (count < 0 || !file_.read(buffer, count))
            throw ModelError("the file ends too early");
        return static_cast<std::uint64_t>(file_.tellg()) < bytes_;
    }
    uint64_t tellg() override { return static_cast<uint64_t>(file_.tellg()); }
    void seekg(uint64_t position) override { file_.seekg(static_cast<std::streamoff>(position)); }
    void clear() override { file_.clear(); }

private:
    std::ifstream file_;
    std::uint64_t bytes_;
};

void readPixels(Stream& stream, const Table& table, int firstRow, int rowCount, std::vector<float>& values)
{
    Imf::InputFile file(stream, 0);
    const std::size_t channels = table.channelNames.size(), size = sizeof(float);
    const auto window = Imath::Box2i({0, firstRow}, {table.columns() - 1, firstRow + rowCount - 1});
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels; ++c)
        buffer.insert(table.channelNames[c],
                      Imf::Slice::Make(Imf::FLOAT, values.data() + c, window, channels * size, table.valueCount(1) * size));
    file.setFrameBuffer(buffer);
    file.readPixels(firstRow, firstRow + rowCount - 1);
}

} // namespace

Model Model::open(const fs::path& directory)
{
    Model model;
    model.directory_ = directory;
    const fs::path path = directory / "manifest.json";
    std::error_code code;
    if (!fs::is_directory(directory, code))
        throw ModelError("There is no model directory '" + directory.string() + "'.");
    if (!fs::is_regular_file(path, code))
        throw ModelError("The directory '" + directory.string() + "' is not a model: it has no manifest.json.");
    try {
        model.manifest_ = parseManifest(readTextFile(path, maxManifestBytes), path.string());
    } catch (const FileError& error) {
        throw ModelError(error.what());
    }
    const fs::path inside = fs::canonical(directory, code);
    for (const auto& [file, info] : model.manifest_.files) {
        const fs::path full = directory / file;
        if (!fs::is_regular_file(full, code))
            throw ModelError("'" + full.string() + "' is missing, though the manifest lists it.");
        if (fs::canonical(full, code) != inside / file)
            throw ModelError("'" + full.string() + "' is a link; a file inside the model is expected.");
        if (const auto bytes = fs::file_size(full, code); code || bytes != info.bytes)
            throw ModelError("'" + full.string() + "' has " + std::to_string(code ? 0 : bytes) + " bytes, the manifest says " +
                             std::to_string(info.bytes) + ".");
    }
    return model;
}

bool Model::hasTable(const std::string& name) const
{
    return std::any_of(tables().begin(), tables().end(), [&](const Table& t) { return t.name == name; });
}

const Table& Model::table(const std::string& name) const
{
    std::string known;
    for (const Table& table : tables()) {
        if (table.name == name)
            return table;
        known += (known.empty() ? "" : ", ") + table.name;
    }
    throw ModelError("The model '" + directory_.string() + "' has no table '" + name + "'. It has: " + (known.empty() ? "none" : known) +
                     ".");
}

std::vector<float> Model::readAll(const std::string& name) const { return readRows(name, 0, table(name).rows()); }

std::vector<float> Model::readRows(const std::string& name, int firstRow, int rowCount) const
{
    const Table& table = this->table(name);
    if (firstRow < 0 || rowCount < 0 || firstRow > table.rows() || rowCount > table.rows() - firstRow)
        throw RangeError("Table '" + name + "' has rows 0 to " + std::to_string(table.rows() - 1) + "; " + std::to_string(rowCount) +
                         " rows from " + std::to_string(firstRow) + " were asked for.");
    if (rowCount == 0)
        return {};
    const std::string place = "'" + (directory_ / table.file).string() + "' (table '" + name + "')";
    const std::uint64_t bytes = manifest_.files.at(table.file).bytes;
    Stream stream(directory_ / table.file, bytes);
    if (!stream.file())
        throw ModelError(place + ": can't be opened.");
    checkExrHeader(stream.file(), bytes, table, place);
    // No compressor of this format does better than 1 : 1032 (deflate); more means that the header lies.
    const std::uint64_t raw = table.valueCount(table.rows()) * (table.half ? 2u : 4u);
    if (raw / 1100 > bytes)
        throw ModelError(place + ": the file is too short for " + std::to_string(table.rows()) + " x " + std::to_string(table.columns()) +
                         " texels.");
    stream.file().clear();
    stream.file().seekg(0);

    std::vector<float> values(table.valueCount(rowCount));
    try {
        readPixels(stream, table, firstRow, rowCount, values);
    } catch (const std::exception& error) {
        throw ModelError(place + ": the image is damaged: " + error.what() + ".");
    }
    const std::size_t rowSize = table.valueCount(1);
    for (int row = 0; row < rowCount; ++row) {
        float* const start = values.data() + static_cast<std::size_t>(row) * rowSize;
        if (table.half) {
            // In double: 2^exponent may lie outside float's range where the value itself does not.
            const double scale = std::ldexp(1., table.rowExponents[static_cast<std::size_t>(firstRow + row)]);
            for (std::size_t i = 0; i < rowSize; ++i)
                start[i] = static_cast<float>(double(start[i]) * scale);
        }
        if (const RowScan scan = scanRow(start, rowSize, table.isSigned); scan.flaw != Flaw::None)
            throw ModelError(place + ": the image is damaged: a value in row " + std::to_string(firstRow + row) + " is " +
                             (scan.flaw == Flaw::Negative ? "negative." : "not finite."));
    }
    return values;
}

std::string Model::text(const std::string& file) const
{
    if (!manifest_.files.contains(file))
        throw ModelError("The model '" + directory_.string() + "' has no file '" + file + "'.");
    try {
        return readTextFile(directory_ / file, maxTextBytes);
    } catch (const FileError& error) {
        throw ModelError(error.what());
    }
}

void Model::verifyChecksums() const
{
    for (const auto& [file, info] : manifest_.files) {
        FileInfo found;
        try {
            found = fileInfo(directory_ / file);
        } catch (const FileError& error) {
            throw ModelError(error.what());
        }
        if (found != info)
            throw ModelError("'" + (directory_ / file).string() + "' is damaged: its checksum is not the one in the manifest.");
    }
}

} // namespace sky::model
