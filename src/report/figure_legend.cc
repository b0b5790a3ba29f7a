#include <algorithm>

#include "report/figure.h"
#include "report/figure_measures.h"
#include "report/setting.h"
#include "report/wrapped_text.h"

namespace tourmaline::report {

namespace {

std::string names_of(const SettingGroup &group) {
  std::string names;
  for (const Boundary *boundary : group.boundaries)
    names += (names.empty() ? "" : ", ") + boundary->name;
  return names;
}

std::vector<std::string> texts_of(const SettingGroup &group) {
  const std::vector<std::string> &texts = group.boundaries.front()->conditions.texts;
  return texts.empty() ? std::vector<std::string>{"no condition"} : texts;
}

}  // namespace

/// A piece of the legend: a name with what is said of it, and what stands before it.
struct Figure::Entry {
  enum class Mark { colour, arrow, none } mark;
  Colour colour;
  std::string name;
  std::vector<std::string> texts;
};

namespace {

using Entry = Figure::Entry;

bool is_poled(const Result &result) {
  const Field *field = result.field("poling");
  return field && std::any_of(field->values.begin(), field->values.end(), [](const auto &values) {
           return std::any_of(values.begin(), values.end(), [](float v) { return v != 0; });
         });
}

std::vector<Entry> entries_of(const Result &result) {
  std::vector<Entry> entries;
  for (const SettingGroup &group : groups_of(result))
    entries.push_back({Entry::Mark::colour, group.colour, names_of(group), texts_of(group)});
  if (has_unnamed_facets(result))
    entries.push_back(
        {Entry::Mark::colour, body_colour, name_of_unnamed(result), {"no condition"}});
  if (is_poled(result))
    entries.push_back({Entry::Mark::arrow, ink, "poling", {"direction of the crystal axis 3"}});
  for (const Part &part : parts_of(result))
    entries.push_back({Entry::Mark::none, ink, part.name, {part.material}});
  return entries;
}

constexpr double legend_size = 7, legend_left = left_margin - 20, legend_names = legend_left + 11,
                 between = 8, legend_width = left_margin + body_size + right_margin - legend_names;

/// An entry in lines that fit: its name, and beside it what is said of it.
struct FittedEntry {
  Entry entry;
  std::vector<std::string> names, said;
  double column = 0;  ///< how wide the names are

  std::size_t n_lines() const { return std::max(names.size(), said.size()); }
};

std::vector<FittedEntry> legend_of(const Result &result, Canvas &canvas) {
  const auto width = [&](bool bold) {
    return [&canvas, bold](const std::string &text) {
      return canvas.text_width(text, legend_size, bold);
    };
  };
  std::vector<FittedEntry> fitted;
  double conditions = 0, others = 0;  // the widest name of each kind
  for (const Entry &entry : entries_of(result)) {
    fitted.push_back({entry, wrapped(entry.name, 0.4 * legend_width, width(true)), {}});
    double &widest = entry.mark == Entry::Mark::colour ? conditions : others;
    for (const std::string &name : fitted.back().names)
      widest = std::max(widest, canvas.text_width(name, legend_size, true));
  }
  for (FittedEntry &piece : fitted) {
    piece.column = piece.entry.mark == Entry::Mark::colour ? conditions : others;
    const double room = legend_width - between - piece.column - 2;
    for (const std::string &text : piece.entry.texts)
      for (const std::string &line : wrapped(text, room, width(false)))
        piece.said.push_back(line);
  }
  return fitted;
}

}  // namespace

void Figure::mark(const Entry &entry, double y) {
  const double left = legend_left, right = left + 7;
  if (entry.mark == Entry::Mark::arrow)
    return arrow({left - 1, y - 2.5}, {right + 1, y - 2.5});
  if (entry.mark == Entry::Mark::none)
    return;
  const std::vector<Canvas::Point> square{
      {left, y - 6}, {right, y - 6}, {right, y + 1}, {left, y + 1}, {left, y - 6}};
  canvas_.area(square, entry.colour);
  if (entry.colour == body_colour)  // too light to be seen on paper
    canvas_.lines({square}, grey, 0.4);
}

void Figure::legend() {
  double y = top_ + height_ + axis_room + 6;
  for (const FittedEntry &piece : legend_of(result_, canvas_)) {
    mark(piece.entry, y);
    for (std::size_t i = 0; i < piece.n_lines(); ++i, y += line_height) {
      if (i < piece.names.size())
        canvas_.text(piece.names[i], {legend_names, y}, Canvas::Align::left, legend_size, true);
      if (i < piece.said.size())
        canvas_.text(piece.said[i], {legend_names + piece.column + between, y}, Canvas::Align::left,
                     legend_size);
    }
  }
}

double legend_height(const Result &result, FigureFormat format) {
  Canvas scratch(format, 1, 1);
  std::size_t lines = 0;
  for (const FittedEntry &piece : legend_of(result, scratch))
    lines += piece.n_lines();
  return static_cast<double>(lines) * line_height + 8;
}

}  // namespace tourmaline::report
