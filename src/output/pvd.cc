#include "output/pvd.h"

#include <fmt/format.h>

namespace tourmaline::output {

std::string pvd_text(std::span<const PvdEntry> series) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const PvdEntry &entry : series)
    text += fmt::format("<DataSet timestep=\"{:.17g}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                        entry.time, entry.file);
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace tourmaline::output
