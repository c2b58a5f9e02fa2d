// Values of JSON files whose shape is not known to be right.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/parse_number.h"
#include "engine/io/text.h"

namespace quorum {

/// The value of a JSON file. what: it should be, for the message. Fails (kInput), naming the line, if its syntax is
/// broken.
inline Expected<nlohmann::json> parse_json(const std::filesystem::path& path, std::string_view text,
                                           std::string_view what = "object") {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const std::string_view before = text.substr(0, error.byte > 0 ? error.byte - 1 : 0);
    return failure_at_line(
        path, 1 + static_cast<int>(std::ranges::count(before, '\n')),
        "is no JSON " + std::string(what) + "; check its syntax here (no comma before a bracket, no NaN, no comments)");
  } catch (const nlohmann::json::exception&) {
    return path_failure(path, "is no JSON " + std::string(what) + "; a number in it is too large");
  }
}

/// Members of one JSON object. Numbers may stand in quotes, as some programs write all of them. What is absent or of
/// another kind gives 0 or nothing, and the first one is kept for done(), which names it.
class JsonObject {
 public:
  using Json = nlohmann::json;

  /// json must outlive the object. Anything but an object has no members.
  explicit JsonObject(const Json& json) : json_(json) {}

  /// Null if it is absent.
  [[nodiscard]] const Json* find(std::string_view name) const {
    if (!json_.is_object()) return nullptr;
    const auto place = json_.find(name);
    return place != json_.end() && !place->is_null() ? &*place : nullptr;
  }
  double number(std::string_view name) {
    const Json* value = find(name);
    const auto result = value != nullptr ? number_of(*value) : std::nullopt;
    if (!result) fail(name, "a number");
    return result.value_or(0.0);
  }
  double number_or(std::string_view name, double otherwise) { return find(name) != nullptr ? number(name) : otherwise; }
  /// Text, or a number as text, as ids are written.
  std::string text(std::string_view name) {
    const Json* value = find(name);
    if (value != nullptr && value->is_string()) return value->get<std::string>();
    if (value != nullptr && value->is_number_integer()) return value->dump();
    fail(name, "text");
    return {};
  }
  std::string text_or_empty(std::string_view name) { return find(name) != nullptr ? text(name) : std::string(); }
  template <int N>
  Eigen::Matrix<double, N, 1> vector(std::string_view name) {
    const Json* value = find(name);
    const auto result = value != nullptr ? vector_of<N>(*value) : std::nullopt;
    if (!result) fail(name, std::to_string(N) + " numbers");
    return result.value_or(Eigen::Matrix<double, N, 1>::Zero());
  }
  /// Fails with the first member that was not as wanted.
  [[nodiscard]] Expected<void> done() const {
    if (problem_.empty()) return {};
    return failure(ErrorKind::kInput, problem_);
  }
  void fail(std::string_view name, std::string_view wanted) {
    if (problem_.empty()) problem_ = "its " + std::string(name) + " is not there, or is not " + std::string(wanted);
  }

  static std::optional<double> number_of(const Json& value) {
    std::optional<double> result;
    if (value.is_number()) result = value.get<double>();
    if (value.is_string()) result = parse_number<double>(value.get_ref<const std::string&>());
    return result && std::isfinite(*result) ? result : std::nullopt;
  }
  template <int N>
  static std::optional<Eigen::Matrix<double, N, 1>> vector_of(const Json& value) {
    if (!value.is_array() || value.size() != N) return std::nullopt;
    Eigen::Matrix<double, N, 1> result;
    for (int i = 0; i < N; ++i) {
      const auto number = number_of(value[static_cast<std::size_t>(i)]);
      if (!number) return std::nullopt;
      result(i) = *number;
    }
    return result;
  }

 private:
  const Json& json_;
  std::string problem_;
};

}  // namespace quorum
