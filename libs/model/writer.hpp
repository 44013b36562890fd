#pragma once
// Writing a model directory: everything goes to a hidden directory beside it, which takes its place on commit.

#include "model/manifest.hpp"
#include <filesystem>
#include <functional>
#include <memory>

namespace sky::model {

struct WriterTable;

/// One table being written, row by row. A handle: cheap to copy; valid until its ModelWriter is gone.
class TableWriter
{
public:
    /// Appends rows.
    ///   firstRow  must be the number of rows written so far: scanlines follow one another
    ///   values    [rowCount][columns][channels], the last running fastest
    ///   throws    NumericsError if a value is not finite, or negative where the table isn't signed: names table and texel
    ///             RangeError if the rows don't follow; FileError, for instance on a full disk
    void writeRows(int firstRow, int rowCount, const float* values);

    const TableSpec& spec() const;

private:
    friend class ModelWriter;
    explicit TableWriter(std::shared_ptr<WriterTable> table) : table_(std::move(table)) {}
    std::shared_ptr<WriterTable> table_;
};

/// A model being written. Without commit() the destructor removes all traces.
class ModelWriter
{
public:
    /// \param directory the model to make or to replace. Not touched before commit().
    /// throws FileError if it can't be written, or if it exists and holds something that is not a model
    explicit ModelWriter(const std::filesystem::path& directory);
    ~ModelWriter();
    ModelWriter(const ModelWriter&) = delete;
    ModelWriter& operator=(const ModelWriter&) = delete;

    /// Begins a table; several may be open at a time. At most 11 significand bits are stored as halves, with an
    /// exponent per row: values below 2^-24 of their row's maximum then lose precision, gradually.
    ///   throws RangeError if the spec is wrong or a table or file of that name exists; FileError
    TableWriter table(const TableSpec& spec);

    /// Writes a whole table.
    void table(const TableSpec& spec, const std::vector<float>& values);

    /// Writes a text file of the model, for instance "description.atmo".
    void text(const std::string& file, const std::string& content);

    /// Completes the model: `manifest` gets the tables and files and is written last, then the directory is put in
    /// place at once. Nothing can be written afterwards.
    ///   breath  called with the fraction done, for the last time just before the directory is replaced; throws to stop
    ///   throws RangeError if a table lacks rows or the manifest is not one that a reader accepts; FileError
    void commit(Manifest manifest, const std::function<void(double)>& breath = {});

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sky::model
