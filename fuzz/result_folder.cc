// Any folder that `report` and `figures` are given is shown or refused with a CaseError. A mutated
// file begins with its name on a line of its own; the others of the folder are those of the seeds,
// whose folder is the working directory's fuzz/seeds/result_folder.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "report/figures.h"
#include "report/page.h"
#include "report/page_template.h"
#include "tourmaline/error.h"

namespace tourmaline::report {

// Of the page only what is put into it matters here.
std::string_view page_template() {
  return "<body></body>";
}

}  // namespace tourmaline::report

namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path &file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path &folder, const std::string &named) {
  const std::size_t end = named.find('\n');
  std::ofstream(folder / named.substr(0, end), std::ios::binary) << named.substr(end + 1);
}

/// The names of the seeds; their files, put into a folder of this process.
const fs::path &folder() {
  static const fs::path made = [] {
    fs::path path = fs::temp_directory_path() / ("fuzz-results-" + std::to_string(getpid()));
    fs::create_directories(path / "results");
    for (const auto &seed : fs::directory_iterator("fuzz/seeds/result_folder"))
      put(path / "results", content_of(seed.path()));
    return path;
  }();
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  using namespace tourmaline;
  const std::string named(data, data + size);
  const std::string name = named.substr(0, named.find('\n'));
  const fs::path seed = fs::path("fuzz/seeds/result_folder") / name;
  if (name.size() == named.size() || name.empty() || name.find('/') != std::string::npos ||
      name.find('\0') != std::string::npos || !fs::is_regular_file(seed))
    return 0;
  const fs::path results = folder() / "results";
  put(results, named);
  try {
    report::write_page({results}, folder() / "page.html");
    report::write_figures(results, folder() / "figures", {});
  } catch (const CaseError &) {
  }
  put(results, content_of(seed));
  return 0;
}
