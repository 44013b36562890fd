// How far two models are apart, table by table: the same description computed on two drivers, or before and after a change.
//
//   bench_compare MODEL REFERENCE
//
// rms and largest relative difference of the values above 1e-6 of a table's largest; of logarithms and ratios, which have signs,
// the absolute difference where they are below one.

#include "base/error.hpp"
#include "model/model.hpp"
#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace sky;

int main(int argc, char** argv)
{
    if (argc != 3) {
        std::fprintf(stderr, "bench_compare: expected MODEL REFERENCE\n");
        return 2;
    }
    try {
        const auto model = model::Model::open(argv[1]), reference = model::Model::open(argv[2]);
        std::printf("%-34s %9s  %9s\n", "table", "rms", "largest");
        for (const auto& table : reference.tables()) {
            const auto a = model.readAll(table.name), b = reference.readAll(table.name);
            if (a.size() != b.size()) {
                std::printf("%-34s the sizes differ\n", table.name.c_str());
                continue;
            }
            const double floor = 1e-6 * double(*std::max_element(b.begin(), b.end()));
            double squares = 0, largest = 0;
            std::size_t count = 0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                const double value = double(b[i]), scale = std::max(table.isSigned ? 1. : 0., std::abs(value));
                if (!table.isSigned && !(value > floor))
                    continue;
                const double difference = std::abs(double(a[i]) - value) / scale;
                squares += difference * difference;
                largest = std::max(largest, difference);
                ++count;
            }
            std::printf("%-34s %9.1e  %9.1e\n", table.name.c_str(), count ? std::sqrt(squares / double(count)) : 0., largest);
        }
    } catch (const Error& error) {
        std::fprintf(stderr, "bench_compare: %s\n", error.what());
        return error.inputMustChange() ? 2 : 1;
    }
}
