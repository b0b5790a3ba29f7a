#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tourmaline::report {

/// Writes the report of one result folder, or of two side by side: one HTML file that holds all it
/// needs, with as many moments of the fields as fit: into `most_bytes` of the file, if that is not
/// 0, else some 12 million numbers. Throws CaseError when a folder is none of ours, or not even one
/// moment fits, MachineError when `file` cannot be written.
void write_page(const std::vector<std::filesystem::path> &folders,
                const std::filesystem::path &file, std::size_t most_bytes = 0);

}  // namespace tourmaline::report
