#pragma once

#include <array>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "../output/temporary_folder.h"
#include "report/canvas.h"

// What an SVG file shows. Styles stand in one attribute or, from cairo 1.18 on, each in its own.

namespace tourmaline::report {

using Place = std::array<double, 2>;  ///< on paper, from the top left [pt]

/// "M 1 2 L 3 4 M 5 6 L 7 8" and the like, by pieces.
inline std::vector<std::vector<Place>> pieces_of(const std::string &path) {
  std::vector<std::vector<Place>> pieces;
  std::istringstream words(path);
  std::string word;
  while (words >> word) {
    if (word == "Z")
      continue;
    if (word == "M")
      pieces.emplace_back();
    Place place{};
    words >> place[0] >> place[1];
    pieces.back().push_back(place);
  }
  return pieces;
}

struct DrawnLine {
  std::string colour;
  std::vector<std::vector<Place>> pieces;
};

/// The lines of that width; those of the data, and apart from them the legend's, have 1.1 pt.
inline std::vector<DrawnLine> drawn_lines(const std::string &svg,
                                          const std::string &width = "1.1") {
  const std::regex line(R"re(stroke-width(?::|="))re" + width +
                        R"re([;"][^>]*stroke(?::|=")(rgb\([^)]*\))[^>]* d="([^"]*)")re");
  std::vector<DrawnLine> lines;
  for (std::sregex_iterator at(svg.begin(), svg.end(), line), end; at != end; ++at)
    lines.push_back({(*at)[1], pieces_of((*at)[2])});
  return lines;
}

struct DrawnArea {
  std::string colour;
  std::vector<Place> corners;
};

inline std::vector<DrawnArea> drawn_areas(const std::string &svg) {
  const std::regex area(R"re([ ;"]fill(?::|=")(rgb\([^)]*\))[^>]* d="([^"]*)")re");
  std::vector<DrawnArea> areas;
  for (std::sregex_iterator at(svg.begin(), svg.end(), area), end; at != end; ++at)
    areas.push_back({(*at)[1], pieces_of((*at)[2]).at(0)});
  return areas;
}

/// Where the marks of that colour stand.
inline std::vector<Place> marks(const std::string &svg, const std::string &colour) {
  std::vector<Place> middles;
  for (const DrawnArea &area : drawn_areas(svg)) {
    if (area.colour != colour)
      continue;
    Place middle{};
    for (const Place &corner : area.corners)
      for (int i = 0; i < 2; ++i)
        middle[i] += corner[i] / static_cast<double>(area.corners.size());
    middles.push_back(middle);
  }
  return middles;
}

/// A title and the like.
struct Written {
  std::string text;
  double size;  ///< [pt]
  bool is_bold = false;
};

/// The letters in their order, which SVG has as outlines.
inline std::string letters_in(const std::string &svg) {
  const std::regex outline(R"re(id="(glyph[-\d]+)">\s*<path[^>]* d="([^"]*)")re"),
      letter(R"re(<use xlink:href="#(glyph[-\d]+)")re");
  std::map<std::string, std::string> outlines;  // of a space there may be none
  for (std::sregex_iterator at(svg.begin(), svg.end(), outline), end; at != end; ++at)
    outlines[(*at)[1]] = (*at)[2];
  std::string letters;
  for (std::sregex_iterator at(svg.begin(), svg.end(), letter), end; at != end; ++at)
    letters += "<" + outlines[(*at)[1]] + ">";
  return letters;
}

/// Whether these stand in the figure, drawn one directly after the other.
inline bool shows(const std::string &svg, const std::vector<Written> &texts) {
  const output::TemporaryFolder folder;
  Canvas canvas(FigureFormat::svg, 300, 300);
  for (const Written &one : texts)
    canvas.text(one.text, {10, 100}, Canvas::Align::left, one.size, one.is_bold);
  canvas.write(folder / "texts.svg");
  return letters_in(svg).find(letters_in(output::content_of(folder / "texts.svg"))) !=
         std::string::npos;
}

}  // namespace tourmaline::report
