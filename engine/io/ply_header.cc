#include "engine/io/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/io/text.h"

namespace quorum {
namespace {

const PlyType* find_type(std::string_view name) {
  const auto* type = std::ranges::find_if(
      kPlyTypes, [name](const PlyType& candidate) { return candidate.name == name || candidate.sized_name == name; });
  return type != kPlyTypes.end() ? type : nullptr;
}

using Tokens = std::vector<std::string_view>;

// Each of the following takes one line of the header and returns what is wrong with it, or "".

std::string parse_format(const Tokens& tokens, PlyHeader& header) {
  if (tokens.size() != 3 || tokens[2] != "1.0") return "expected \"format KIND 1.0\"";
  if (tokens[1] == "ascii")
    header.format = PlyFormat::kAscii;
  else if (tokens[1] == "binary_little_endian")
    header.format = PlyFormat::kLittleEndian;
  else if (tokens[1] == "binary_big_endian")
    header.format = PlyFormat::kBigEndian;
  else
    return "unknown format " + quote_token(tokens[1]);
  return "";
}

std::string parse_element(const Tokens& tokens, PlyHeader& header) {
  const auto count = tokens.size() == 3 ? parse_number<std::uint64_t>(tokens[2]) : std::nullopt;
  if (!count) return "expected \"element NAME COUNT\"";
  if (header.find(tokens[1]) != nullptr) return "element " + quote_token(tokens[1]) + " appears twice";
  header.elements.push_back({std::string(tokens[1]), *count, {}});
  return "";
}

std::string parse_property(const Tokens& tokens, PlyHeader& header) {
  if (header.elements.empty()) return "a property before any element";
  PlyElement& element = header.elements.back();
  const bool is_list = tokens.size() == 5 && tokens[1] == "list";
  if (!is_list && tokens.size() != 3) return "expected \"property TYPE NAME\" or \"property list TYPE TYPE NAME\"";
  PlyProperty property{std::string(tokens.back()), find_type(tokens[is_list ? 3 : 1]), nullptr};
  if (property.type == nullptr) return "unknown type " + quote_token(tokens[is_list ? 3 : 1]);
  if (is_list) {
    property.count_type = find_type(tokens[2]);
    if (property.count_type == nullptr || !property.count_type->is_integer)
      return "expected an integer type for the length of a list, found " + quote_token(tokens[2]);
  }
  if (element.find(property.name) >= 0) return "property " + quote_token(property.name) + " appears twice";
  element.properties.push_back(std::move(property));
  return "";
}

/// Comments are free text; one that only looks like an offset is none.
std::string take_offset(const Tokens& tokens, PlyHeader& header) {
  if (tokens.size() != 5 || tokens[1] != "offset") return "";
  Eigen::Vector3d offset;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = parse_number<double>(tokens[axis + 2]);
    if (!value || !std::isfinite(*value)) return "";
    offset(static_cast<Eigen::Index>(axis)) = *value;
  }
  header.offset = offset;
  return "";
}

std::string parse_header_line(const Tokens& tokens, PlyHeader& header) {
  const std::string_view keyword = tokens.empty() ? "" : tokens[0];
  if (keyword == "comment") return take_offset(tokens, header);
  if (keyword == "obj_info") return "";
  if (keyword == "format") return parse_format(tokens, header);
  if (keyword == "element") return parse_element(tokens, header);
  if (keyword == "property") return parse_property(tokens, header);
  return "unknown keyword " + quote_token(keyword);
}

/// What the elements of a finished header lack, or "".
std::string find_defect(const PlyHeader& header) {
  if (!header.format) return "the header names no format";
  for (const PlyElement& element : header.elements)
    if (element.count > 0 && element.properties.empty())
      return "element " + quote_token(element.name) + " has no properties";
  const PlyElement* vertices = header.find("vertex");
  if (vertices == nullptr) return "the header has no element vertex";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "confidence", "quality"}) {
    const int index = vertices->find(name);
    if (index < 0 && std::string_view("xyz").contains(name)) return fmt::format("vertex has no property {}", name);
    if (index >= 0 && vertices->properties[index].count_type != nullptr)
      return fmt::format("vertex property {} is a list, expected a number", name);
  }
  return "";
}

}  // namespace

Expected<PlyHeader> read_ply_header(const std::filesystem::path& path, std::string_view bytes) {
  LineReader lines(bytes);
  if (lines.next() != "ply") return failure_at_line(path, 1, "expected ply: not a PLY file");
  PlyHeader header;
  while (const auto line = lines.next()) {
    const Tokens tokens = split_tokens(*line);
    const bool at_end = tokens.size() == 1 && tokens[0] == "end_header";
    const std::string defect = at_end ? find_defect(header) : parse_header_line(tokens, header);
    if (!defect.empty()) return failure_at_line(path, lines.number(), defect);
    if (!at_end) continue;
    header.size = lines.position();
    header.lines = lines.number();
    return header;
  }
  return failure_at_line(path, lines.number(), "the header has no end_header");
}

}  // namespace quorum
