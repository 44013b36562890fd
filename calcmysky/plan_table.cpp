#include "plan_table.hpp"

#include <algorithm>
#include <iomanip>

#include "values.hpp"

namespace sky::cli {

namespace {

struct Widths {
    int what, verdict = 8, time = 13, memory = 9, disk = 9;
};

void printRow(const Widths& widths, const solver::PlanItem& item, const std::string& verdict, std::ostream& to)
{
    const std::string time = item.seconds > 0 ? formatDuration(item.seconds) : "-";
    to << std::left << std::setw(widths.what) << item.what << "  " << std::setw(widths.verdict) << verdict << std::right
       << std::setw(widths.time) << time << std::setw(widths.memory) << formatSize(item.memoryBytes) << std::setw(widths.disk)
       << formatSize(item.diskBytes);
    if (!item.why.empty())
        to << "  " << item.why;
    to << "\n";
}

} // namespace

void printPlan(const std::vector<solver::PlanItem>& plan, std::ostream& to)
{
    solver::PlanItem total{"total", true, "memory: the largest stage", 0, 0, 0};
    Widths widths{static_cast<int>(total.what.size())};
    for (const solver::PlanItem& item : plan) {
        widths.what = std::max(widths.what, static_cast<int>(item.what.size()));
        if (!item.computed)
            continue;
        total.memoryBytes = std::max(total.memoryBytes, item.memoryBytes);
        total.diskBytes += item.diskBytes;
        total.seconds += item.seconds;
    }
    to << std::left << std::setw(widths.what) << "what"
       << "  " << std::setw(widths.verdict) << "" << std::right << std::setw(widths.time) << "time" << std::setw(widths.memory) << "memory"
       << std::setw(widths.disk) << "disk"
       << "  why\n";
    for (const solver::PlanItem& item : plan)
        printRow(widths, item, item.computed ? "computed" : "skipped", to);
    printRow(widths, total, "", to);
    to << "Time, memory and disk are estimates." << std::endl;
}

} // namespace sky::cli
