#include "report/colour_map.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace tourmaline::report {
namespace {

using Triple = std::array<double, 3>;

double to_linear(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double from_linear(double c) {
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

Triple multiply(const std::array<Triple, 3> &m, const Triple &v) {
  Triple result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i] += m[i][j] * v[j];
  return result;
}

// B. Ottosson, A perceptual color space for image processing, 2020.
Triple oklab(std::uint32_t hex) {
  Triple linear;
  for (int i = 0; i < 3; ++i)
    linear[i] = to_linear(((hex >> (16 - 8 * i)) & 0xff) / 255.);
  Triple lms = multiply({{{0.4122214708, 0.5363325363, 0.0514459929},
                          {0.2119034982, 0.6806995451, 0.1073969566},
                          {0.0883024619, 0.2817188376, 0.6299787005}}},
                        linear);
  for (double &c : lms)
    c = std::cbrt(c);
  return multiply({{{0.2104542553, 0.7936177850, -0.0040720468},
                    {1.9779984951, -2.4285922050, 0.4505937099},
                    {0.0259040371, 0.7827717662, -0.8086757660}}},
                  lms);
}

Colour srgb(const Triple &lab) {
  Triple lms = multiply({{{1, 0.3963377774, 0.2158037573},
                          {1, -0.1055613458, -0.0638541728},
                          {1, -0.0894841775, -1.2914855480}}},
                        lab);
  for (double &c : lms)
    c = c * c * c;
  const Triple linear = multiply({{{4.0767416621, -3.3077115913, 0.2309699292},
                                   {-1.2684380046, 2.6097574011, -0.3413193965},
                                   {-0.0041960863, -0.7034186147, 1.7076147010}}},
                                 lms);
  Colour colour;
  for (int i = 0; i < 3; ++i)
    colour[i] =
        static_cast<std::uint8_t>(std::lround(255 * from_linear(std::clamp(linear[i], 0., 1.))));
  return colour;
}

ColourMap through(std::span<const std::uint32_t> stops) {
  ColourMap map;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double at =
        static_cast<double>(i) / (map.size() - 1) * static_cast<double>(stops.size() - 1);
    const auto left = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const Triple a = oklab(stops[left]), b = oklab(stops[left + 1]);
    Triple mixed;
    for (int c = 0; c < 3; ++c)
      mixed[c] = a[c] + (at - static_cast<double>(left)) * (b[c] - a[c]);
    map[i] = srgb(mixed);
  }
  return map;
}

}  // namespace

const ColourMap &viridis() {
  static constexpr std::uint32_t stops[] = {
      0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e, 0x1f988b,
      0x22a884, 0x35b779, 0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xeae51a, 0xfde725};
  static const ColourMap map = through(stops);
  return map;
}

const ColourMap &blue_red() {
  static constexpr std::uint32_t stops[] = {0x0b3c7f, 0xe8e6e3, 0x8a1020};
  static const ColourMap map = through(stops);
  return map;
}

ColourRange colour_range(double least, double greatest) {
  const double size = std::max(-least, greatest);
  if (least < 0 && greatest > 0 && std::min(-least, greatest) > size / 10)
    return {-size, size, true};
  if (least == greatest) {
    const double half = least == 0 ? 1 : std::abs(least) / 2;
    return {least - half, greatest + half, false};
  }
  return {least, greatest, false};
}

Colour colour_of(double value, const ColourRange &range) {
  const double at = (value - range.low) / (range.high - range.low) * 255;
  const auto entry = static_cast<std::size_t>(std::lround(std::clamp(at, 0., 255.)));
  return (range.diverging ? blue_red() : viridis())[entry];
}

}  // namespace tourmaline::report
