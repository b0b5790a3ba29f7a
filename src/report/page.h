#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tourmaline::report {

/// Writes the report of one result folder, or of two side by side: one HTML file that holds all it
/// needs. Throws CaseError when a folder is none of ours, MachineError when `file` cannot be
/// written.
void write_page(const std::vector<std::filesystem::path> &folders,
                const std::filesystem::path &file);

}  // namespace tourmaline::report
