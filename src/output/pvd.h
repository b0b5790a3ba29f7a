#pragma once

#include <span>
#include <string>

namespace tourmaline::output {

/// One field file of a series: when it holds, and its name relative to the collection.
struct PvdEntry {
  double time;  // s
  std::string file;
};

/// ParaView's collection file (.pvd) of the series.
std::string pvd_text(std::span<const PvdEntry> series);

}  // namespace tourmaline::output
