// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// SVG by SVG++, a Boost library of headers: paths, basic shapes and transforms become corners.
// Documentation: docs/devices/shapes.md
// The library's own warnings, and those of its templates where they meet this code, are not ours.
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "studies/shape/outline.hpp"

#include <boost/mpl/insert.hpp>
#include <boost/mpl/set.hpp>
#include <rapidxml_ns/rapidxml_ns.hpp>
#include <svgpp/policy/xml/rapidxml_ns.hpp>
#include <svgpp/svgpp.hpp>

namespace feltgate::shape {

namespace {

using Matrix = std::array<double, 6>;

constexpr std::size_t most_depth = 1000;

struct TooMany {};

/// Receives the library's calls while it traverses the document.
class Collector {
 public:
  std::vector<Outline> outlines;
  bool open = false;  ///< one of them

  void on_enter_element(svgpp::tag::element::any) {
    commands_ = 0;
    matrices_.push_back(matrices_.back());
  }
  /// Only now all of its attributes were told, a transform behind its path too.
  void on_exit_element() {
    const Matrix& m = matrices_.back();
    for (; placed_ < outlines.size(); ++placed_) {
      for (Point& p : outlines[placed_]) {
        // SVG counts y downward.
        p = {m[0] * p.x + m[2] * p.y + m[4], -(m[1] * p.x + m[3] * p.y + m[5])};
      }
    }
    matrices_.pop_back();
  }
  template <class Numbers>
  void transform_matrix(const Numbers& m) {
    const Matrix& a = matrices_.back();
    matrices_.back() = {a[0] * m[0] + a[2] * m[1],        a[1] * m[0] + a[3] * m[1],
                        a[0] * m[2] + a[2] * m[3],        a[1] * m[2] + a[3] * m[3],
                        a[0] * m[4] + a[2] * m[5] + a[4], a[1] * m[4] + a[3] * m[5] + a[5]};
  }

  using Absolute = svgpp::tag::coordinate::absolute;
  void path_move_to(double x, double y, Absolute) {
    end();
    add({x, y});
  }
  void path_line_to(double x, double y, Absolute) { add({x, y}); }
  void path_cubic_bezier_to(double x1, double y1, double x2, double y2, double x, double y,
                            Absolute) {
    const Point p0 = at_, p1{x1, y1}, p2{x2, y2}, p3{x, y};
    for (int i = 1; i < curve_steps; ++i) {
      const double t = static_cast<double>(i) / curve_steps, u = 1 - t;
      corners_.push_back(p0 * (u * u * u) + p1 * (3 * u * u * t) + p2 * (3 * u * t * t) +
                         p3 * (t * t * t));
    }
    add(p3);
  }
  void path_close_subpath() {
    closed_ = true;
    end();
  }
  void path_exit() { end(); }

 private:
  void add(Point p) {
    at_ = p;
    corners_.push_back(p);
    if (++commands_ > most_commands) throw TooMany{};
  }
  /// An outline that ends where it began is closed too.
  void end() {
    if (corners_.size() > 2) {
      const Point gap = corners_.back() - corners_.front();
      open |= !closed_ && std::hypot(gap.x, gap.y) >= 1e-9;
      outlines.push_back(corners_);
    }
    corners_.clear();
    closed_ = false;
  }

  std::vector<Matrix> matrices_{{1, 0, 0, 1, 0, 0}};
  Outline corners_;
  Point at_;
  std::size_t placed_ = 0;  ///< outlines that have their transforms
  bool closed_ = false;
  int commands_ = 0;
};

/// Ignores names that are not in SVG, for example those of drawing programs.
struct Tolerant : svgpp::policy::error::raise_exception<Collector> {
  template <class Element, class Name>
  static bool unknown_element(Collector const&, Element const&, Name const&) {
    return true;
  }
  template <class... All>
  static bool unknown_attribute(Collector const&, All const&...) {
    return true;
  }
};

namespace tag = svgpp::tag;
using Elements = boost::mpl::set<tag::element::svg, tag::element::g, tag::element::path,
                                 tag::element::polygon, tag::element::polyline, tag::element::rect,
                                 tag::element::circle, tag::element::ellipse>::type;
using Attributes = boost::mpl::insert<svgpp::traits::shapes_attributes_by_element,
                                      tag::attribute::transform>::type;
using Walk = svgpp::document_traversal<
    svgpp::processed_elements<Elements>, svgpp::processed_attributes<Attributes>,
    svgpp::path_policy<svgpp::policy::path::minimal>, svgpp::error_policy<Tolerant>>;

constexpr std::string_view kNamespace = "http://www.w3.org/2000/svg";

/// Largest number of open tags: the libraries recurse into elements. Tags in comments count as
/// well.
std::size_t depth_of(const std::string& text) {
  std::size_t depth = 0, most = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const char next = text[i + 1];
    if (text[i] == '<' && next == '/') depth -= depth > 0 ? 1 : 0;
    if (text[i] == '/' && next == '>') depth -= depth > 0 ? 1 : 0;
    if (text[i] == '<' && next != '/' && next != '!' && next != '?') most = std::max(most, ++depth);
  }
  return most;
}

}  // namespace

Outline read_svg(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.good() && text.empty()) {
    throw std::invalid_argument(path + ": cannot be read; check the path");
  }
  const auto refuse = [&](std::string what, long line = 1) {
    // A message of the library may have bytes of the file in it.
    std::replace_if(
        what.begin(), what.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    throw std::invalid_argument(fmt::format("{}:{}: {}", path, line, what));
  };
  if (depth_of(text) > most_depth) {
    refuse(fmt::format("elements in more than {} others; ungroup the drawing", most_depth));
  }
  std::vector<char> buffer(text.begin(), text.end());
  buffer.push_back('\0');
  rapidxml_ns::xml_document<> document;
  Collector found;
  const auto line_at = [&](const char* place) {
    // Of a prefix without a namespace the library tells no place.
    const bool inside = place >= buffer.data() && place <= buffer.data() + text.size();
    return 1 +
           (inside ? std::count(text.begin(), text.begin() + (place - buffer.data()), '\n') : 0);
  };
  try {
    document.parse<rapidxml_ns::parse_no_string_terminators>(buffer.data());
    const rapidxml_ns::xml_node<>* svg = document.first_node();
    if (svg == nullptr) refuse("no element; write an SVG file with one closed path");
    if (std::string_view(svg->namespace_uri(), svg->namespace_uri_size()) != kNamespace) {
      refuse(fmt::format("no SVG; write <svg xmlns=\"{}\"> around the path", kNamespace),
             line_at(svg->name()));
    }
    Walk::load_document(svg, found);
  } catch (const rapidxml_ns::parse_error& e) {
    refuse(fmt::format("no whole XML: {}; save the drawing again", e.what()),
           line_at(e.where<char>()));
  } catch (const TooMany&) {
    refuse(
        fmt::format("a path of more than {} corners and curves; simplify it in a drawing program",
                    most_commands));
  } catch (const svgpp::exception_base& e) {
    refuse(fmt::format("{}; save the drawing as plain SVG", e.what()));
  }
  if (found.outlines.empty()) refuse("no path; draw one closed outline");
  if (found.outlines.size() > 1) {
    refuse(fmt::format("{} outlines; unite them to one, a hidden shape has no holes",
                       found.outlines.size()));
  }
  if (found.open) refuse("the path is open; close it (z at its end)");
  return found.outlines.front();
}

}  // namespace feltgate::shape
