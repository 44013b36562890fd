#pragma once
// What `calcmysky verify` found, as a table for people and as JSON for programs.

#include <ostream>
#include <string>
#include <vector>

#include "model/evaluate.hpp"
#include "montecarlo/reference.hpp"
#include "verify_samples.hpp"

namespace sky::cli {

/// One sample: what the model says and what the judge says, per unit solar irradiance, 1/sr.
struct VerifiedRow {
    Sample sample;
    double wavelengthNm = 0;
    double modelSingle = 0, modelMultiple = 0;
    montecarlo::Result judged;

    double error() const { return (modelSingle + modelMultiple) / judged.total() - 1; }
    double singleError() const { return (modelSingle - judged.single) / judged.total(); } ///< share of error()
};

struct Verification {
    std::string directory, source;
    int orders = 0; ///< 0: all
    double seconds = 0;
    SampleScale scale;
    std::vector<VerifiedRow> rows; ///< those with light of which the reference is sure
    int darkRows = 0;              ///< samples without light in the reference: relative errors mean nothing there
    int unsureRows = 0;            ///< samples of which the reference stayed unsure: isSure()
};

void printTable(const Verification& verification, std::ostream& to);
void writeJson(const Verification& verification, std::ostream& to);

/// Largest rms error of all cells, noise removed, relative.
///   throws  NumericsError where no sample could be judged
double largestError(const Verification& verification);

} // namespace sky::cli
