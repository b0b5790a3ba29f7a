#pragma once

#include <filesystem>
#include <vector>

namespace tourmaline::report {

/// Throws CaseError for a time that somebody asks for and that is not between 0 and the last one
/// [s]. Round-off counts as nothing.
void require_moment(double asked, double last);

/// A file of fields and its time [s].
struct RecordedMoment {
  double time;
  std::filesystem::path file;
};

/// What a list of field files, as ParaView reads them, names; nothing where there is no such list.
/// Throws CaseError when it is damaged.
std::vector<RecordedMoment> recorded_moments(const std::filesystem::path &folder, const char *list);

}  // namespace tourmaline::report
