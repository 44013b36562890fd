#include "exhibit.hpp"

#include "base/error.hpp"
#include "places.hpp"

namespace showmysky::app::preview {

namespace {

namespace fs = std::filesystem;

constexpr auto lookInterval = std::chrono::milliseconds(150); // two looks see an edit: 0.3 s

} // namespace

bool Exhibit::isDescription() const { return path_.extension() == ".atmo"; }

void Exhibit::open(const fs::path& path)
{
    path_ = path;
    watch_.reset();
    if (isDescription())
        watch_.emplace(path_);
    reload();
}

void Exhibit::reload()
{
    problem_.clear();
    computation_.reset();
    next_.reset();
    if (path_.empty())
        return;
    try {
        if (isDescription())
            computation_ = std::make_unique<Computation>(findCalcmysky(), path_, modelDirectoryOf(path_));
        else
            beginLoading(path_);
    } catch (const std::exception& error) {
        problem_ = error.what();
    }
}

void Exhibit::beginLoading(const fs::path& modelDirectory)
{
    next_ = std::make_unique<Sky>(modelDirectory.string(), loader_);
    progress_ = {false, 0, "Opening the model"};
}

bool Exhibit::update(Clock::time_point now)
{
    if (watch_ && now - lastLook_ >= lookInterval) {
        lastLook_ = now;
        if (watch_->changed())
            reload();
    }
    try {
        if (computation_) {
            computation_->update();
            if (!computation_->done())
                return false;
            problem_ = computation_->problem();
            computation_.reset();
            if (problem_.empty()) {
                beginLoading(modelDirectoryOf(path_));
                forgetOldModels(modelDirectoryOf(path_));
            }
        } else if (next_) {
            progress_ = next_->loadStep();
            if (progress_.done) {
                shown_ = std::move(next_);
                return true;
            }
        }
    } catch (const std::exception& error) {
        problem_ = error.what();
        next_.reset();
        computation_.reset();
    }
    return false;
}

std::string Exhibit::activity() const
{
    if (computation_)
        return "Computing " + path_.filename().string() + ": " + computation_->stage();
    return next_ ? progress_.activity : std::string();
}

double Exhibit::fraction() const { return computation_ ? computation_->fraction() : next_ ? progress_.fraction : 1; }

} // namespace showmysky::app::preview
