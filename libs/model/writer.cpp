#include "model/writer.hpp"
#include "base/error.hpp"
#include "base/files.hpp"
#include "model/checksum.hpp"
#include "model/precision.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <optional>
#include <set>
#include <thread>

namespace sky::model {

namespace fs = std::filesystem;

// A stream that remembers the system's reason: OpenEXR writes its last bytes in a destructor, where errors are lost.
class CheckedStream : public Imf::OStream
{
public:
    explicit CheckedStream(const fs::path& path) : Imf::OStream(path.string().c_str()), path_(path)
    {
        errno = 0;
        file_.open(path, std::ios::binary | std::ios::trunc);
        check();
    }
    void write(const char bytes[], int count) override
    {
        file_.write(bytes, count);
        check();
    }
    uint64_t tellp() override { return static_cast<uint64_t>(file_.tellp()); }
    void seekp(uint64_t position) override
    {
        file_.seekp(static_cast<std::streamoff>(position));
        check();
    }
    void close()
    {
        file_.close();
        check();
    }
    void check()
    {
        if (!file_)
            throw FileError("Can't write '" + path_.string() + "': " + systemReason(errno ? errno : EIO) + ".");
    }

private:
    fs::path path_;
    std::ofstream file_;
};

namespace {

// As units are written in the spectral layout: "W.m^-2.sr^-1.nm^-1".
std::string dotted(std::string unit)
{
    std::replace(unit.begin(), unit.end(), ' ', '.');
    return unit;
}

Imf::Header makeHeader(const Table& table)
{
    Imf::Header header(table.columns(), table.rows());
    for (const std::string& channel : table.channelNames)
        header.channels().insert(channel, Imf::Channel(table.half ? Imf::HALF : Imf::FLOAT));
    // Measured on smooth tables (docs/format.md): PIZ takes half to a quarter of ZIP's time at about its size. Moments it leaves as they are.
    header.compression() = table.channels == Channels::Named ? Imf::ZIP_COMPRESSION : Imf::PIZ_COMPRESSION;
    if (table.channels == Channels::SpectralRadiance || table.channels == Channels::SpectralDimensionless)
        header.insert("spectralLayoutVersion", Imf::StringAttribute("1.0"));
    if (table.channels == Channels::SpectralRadiance)
        header.insert("emissiveUnits", Imf::StringAttribute(dotted(table.unit)));
    header.insert("table", Imf::StringAttribute(table.name));
    header.insert("quantity", Imf::StringAttribute(table.quantity));
    header.insert("unit", Imf::StringAttribute(table.unit));
    return header;
}

const char* words(Flaw flaw)
{
    switch (flaw) {
    case Flaw::NotANumber: return "not a number";
    case Flaw::Infinite: return "infinite";
    case Flaw::Negative: return "negative";
    case Flaw::None: break;
    }
    return "fine";
}

std::string lowerCase(std::string text)
{
    for (char& c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

} // namespace

struct WriterTable {
    Table table;
    fs::path path;
    std::optional<CheckedStream> stream;
    std::optional<Imf::OutputFile> file;
    int rowsWritten = 0;
    std::vector<float> rounded;
    std::vector<std::uint16_t> halves;

    void write(int firstRow, int rowCount, const float* values);
    void close();

    ~WriterTable()
    {
        // An incomplete file is about to be removed; what OpenEXR makes of closing it doesn't matter.
        try {
            file.reset();
        } catch (const std::exception&) {
        }
    }
};

void WriterTable::write(int firstRow, int rowCount, const float* values)
{
    if (firstRow != rowsWritten || rowCount < 0 || rowCount > table.rows() - rowsWritten)
        throw RangeError("Table '" + table.name + "': rows " + std::to_string(firstRow) + " to " + std::to_string(firstRow + rowCount) +
                         " were given, rows from " + std::to_string(rowsWritten) + " to at most " + std::to_string(table.rows()) +
                         " are expected.");
    if (rowCount == 0)
        return;
    const std::size_t rowSize = table.valueCount(1), channels = table.channelNames.size();
    const std::size_t total = table.valueCount(rowCount);
    const bool rounding = !table.half && table.significandBits < 24;
    halves.resize(table.half ? total : 0);
    rounded.resize(rounding ? total : 0);
    for (int row = 0; row < rowCount; ++row) {
        const std::size_t start = static_cast<std::size_t>(row) * rowSize;
        const RowScan scan = scanRow(values + start, rowSize, table.isSigned);
        if (scan.flaw != Flaw::None) {
            const int column = static_cast<int>(scan.position / channels);
            throw NumericsError("Table '" + table.name + "': the value at row " + std::to_string(firstRow + row) + ", column " +
                                std::to_string(column) + " (" + table.describeTexel(firstRow + row, column) + "), channel " +
                                table.channelNames[scan.position % channels] + " is " + words(scan.flaw) + ". No model was written.");
        }
        if (table.half) {
            const int exponent = rowExponent(scan.largest, table.rowExponents.empty() ? 0 : table.rowExponents.back());
            table.rowExponents.push_back(exponent);
            toHalves(values + start, rowSize, table.significandBits, exponent, halves.data() + start);
        } else if (rounding)
            for (std::size_t i = start; i < start + rowSize; ++i)
                rounded[i] = roundedToBits(values[i], table.significandBits);
    }

    const std::size_t size = table.half ? sizeof(std::uint16_t) : sizeof(float);
    const void* data = table.half ? static_cast<const void*>(halves.data()) : rounding ? rounded.data() : values;
    // OpenEXR's frame buffers aren't const, though writing only reads them.
    char* base = const_cast<char*>(static_cast<const char*>(data));
    const auto window = Imath::Box2i({0, firstRow}, {table.columns() - 1, firstRow + rowCount - 1});
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels; ++c)
        buffer.insert(table.channelNames[c],
                      Imf::Slice::Make(table.half ? Imf::HALF : Imf::FLOAT, base + c * size, window, channels * size, rowSize * size));
    try {
        file->setFrameBuffer(buffer);
        file->writePixels(rowCount);
    } catch (const std::exception&) {
        stream->check(); // throws with the system's reason if it was the disk
        throw;
    }
    rowsWritten += rowCount;
    if (rowsWritten == table.rows())
        close();
}

void WriterTable::close()
{
    file.reset();
    stream->close();
    stream.reset();
    halves = {};
    rounded = {};
    syncFile(path);
}

void TableWriter::writeRows(int firstRow, int rowCount, const float* values) { table_->write(firstRow, rowCount, values); }

const TableSpec& TableWriter::spec() const { return table_->table; }

struct ModelWriter::State {
    explicit State(const fs::path& target) : directory(target) {}

    ReplacementDirectory directory;
    std::vector<std::shared_ptr<WriterTable>> tables;
    std::set<std::string> tableNames;
    std::set<std::string> foldedFiles; // lower case: some file systems don't tell cases apart
    std::vector<std::string> files;

    fs::path claim(const std::string& file)
    {
        if (!isPlainRelativePath(file))
            throw RangeError("The file name '" + file + "' is not a plain relative name inside the model.");
        if (!foldedFiles.insert(lowerCase(file)).second || lowerCase(file) == "manifest.json")
            throw RangeError("The model already has a file '" + file + "'.");
        files.push_back(file);
        const fs::path path = directory.path() / file;
        std::error_code code;
        fs::create_directories(path.parent_path(), code);
        if (code)
            throw FileError("Can't make the directory '" + path.parent_path().string() + "': " + code.message() + ".");
        return path;
    }
};

ModelWriter::ModelWriter(const fs::path& directory)
{
    std::error_code code;
    if (fs::is_directory(directory, code) && !fs::is_empty(directory, code) && !isModelDirectory(directory.string()))
        throw FileError("The directory '" + directory.string() +
                        "' holds something that is not a model; it is left alone. Name a new or empty directory.");
    state_ = std::make_unique<State>(directory);
    if (Imf::globalThreadCount() == 0)
        Imf::setGlobalThreadCount(static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u)));
}

ModelWriter::~ModelWriter() = default;

TableWriter ModelWriter::table(const TableSpec& spec)
{
    validate(spec);
    if (!state_->tableNames.insert(spec.name).second)
        throw RangeError("The model already has a table '" + spec.name + "'.");
    auto writer = std::make_shared<WriterTable>();
    Table& table = writer->table;
    static_cast<TableSpec&>(table) = spec;
    table.channelNames = channelNamesOf(spec);
    table.half = spec.significandBits <= 11;
    if (table.file.empty())
        table.file = safeFileName(spec.name);
    writer->path = state_->claim(table.file);
    writer->stream.emplace(writer->path);
    writer->file.emplace(*writer->stream, makeHeader(table));
    state_->tables.push_back(writer);
    return TableWriter(writer);
}

void ModelWriter::table(const TableSpec& spec, const std::vector<float>& values)
{
    TableWriter writer = table(spec);
    const std::size_t expected = writer.table_->table.valueCount(spec.rows());
    if (values.size() != expected)
        throw RangeError("Table '" + spec.name + "': " + std::to_string(values.size()) + " values were given, " + std::to_string(expected) +
                         " are expected.");
    writer.writeRows(0, spec.rows(), values.data());
}

void ModelWriter::text(const std::string& file, const std::string& content) { writeTextFile(state_->claim(file), content); }

void ModelWriter::commit(Manifest manifest, const std::function<void(double)>& breath)
{
    manifest.tables.clear();
    manifest.files.clear();
    for (const auto& writer : state_->tables) {
        if (writer->rowsWritten != writer->table.rows())
            throw RangeError("Table '" + writer->table.name + "' has " + std::to_string(writer->rowsWritten) + " of " +
                             std::to_string(writer->table.rows()) + " rows; the model can't be completed.");
        manifest.tables.push_back(writer->table);
    }
    const fs::path& directory = state_->directory.path();
    const auto breathe = [&](double fraction) {
        if (breath)
            breath(fraction);
    };
    for (const std::string& file : state_->files) {
        breathe(double(manifest.files.size()) / double(state_->files.size()));
        manifest.files[file] = fileInfo(directory / file);
    }
    const std::string text = writeManifest(manifest);
    try {
        parseManifest(text, "manifest.json");
    } catch (const ModelError& error) {
        throw RangeError(std::string("The model can't be completed, its manifest is wrong: ") + error.what());
    }
    // The target may have changed since the beginning, hours ago.
    const fs::path& target = state_->directory.target();
    std::error_code code;
    if (fs::is_directory(target, code) && !fs::is_empty(target, code) && !isModelDirectory(target.string()))
        throw FileError("Meanwhile something that is not a model was put into '" + target.string() +
                        "'; it is left alone and the new model is dropped.");
    writeTextFile(directory / "manifest.json", text);
    breathe(1);
    state_->directory.replaceTarget();
}

} // namespace sky::model
