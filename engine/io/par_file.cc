#include "engine/io/par_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "engine/io/text.h"

namespace quorum {
namespace {

constexpr std::size_t kNumberCount = 21;
constexpr std::array<const char*, kNumberCount> kFieldNames = {"k11", "k12", "k13", "k21", "k22", "k23", "k31",
                                                               "k32", "k33", "r11", "r12", "r13", "r21", "r22",
                                                               "r23", "r31", "r32", "r33", "t1",  "t2",  "t3"};

/// A column header has several words and no number; a view with a slip of the pen still has numbers.
bool is_column_header(const std::vector<std::string_view>& tokens) {
  const auto is_number = [](std::string_view token) { return parse_number<double>(token).has_value(); };
  return tokens.size() > 1 && std::ranges::none_of(tokens, is_number);
}

Camera camera_of(const std::array<double, kNumberCount>& numbers) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Camera camera;
  camera.intrinsics = Eigen::Map<const RowMajor>(numbers.data());
  camera.camera_from_world = Eigen::Map<const RowMajor>(numbers.data() + 9);
  camera.translation = Eigen::Map<const Eigen::Vector3d>(numbers.data() + 18);
  if (const double scale = camera.intrinsics(2, 2); scale != 0.0) camera.intrinsics /= scale;
  return camera;
}

/// The last 21 fields are numbers; what stands before them is the name, which may have spaces in it.
Expected<ParLine> parse_view(const std::filesystem::path& path, int line, std::vector<std::string_view> tokens) {
  if (tokens.size() > kNumberCount + 1 && !parse_number<double>(tokens[tokens.size() - kNumberCount - 1])) {
    const std::string_view last = tokens[tokens.size() - kNumberCount - 1];
    tokens.erase(tokens.begin() + 1, tokens.end() - kNumberCount);
    tokens[0] = {tokens[0].data(), static_cast<std::size_t>(last.data() + last.size() - tokens[0].data())};
  }
  if (tokens.size() != kNumberCount + 1)
    return failure_at_line(path, line, fmt::format("expected {} fields, found {}", kNumberCount + 1, tokens.size()));
  std::array<double, kNumberCount> numbers = {};
  for (std::size_t i = 0; i < kNumberCount; ++i) {
    const auto number = parse_number<double>(tokens[i + 1]);
    if (!number)
      return failure_at_line(path, line,
                             fmt::format("{} = {} is not a number", kFieldNames[i], quote_token(tokens[i + 1])));
    numbers[i] = *number;
  }
  ParLine view{line, std::string(tokens[0]), camera_of(numbers)};
  if (const char* defect = camera_defect(view.camera); defect != nullptr)
    return failure_at_line(path, line, fmt::format("{}; {}", defect, kCameraRemedy));
  return view;
}

}  // namespace

Expected<std::vector<ParLine>> parse_par_file(const std::filesystem::path& path, std::string_view text) {
  std::vector<ParLine> views;
  std::optional<std::uint64_t> count;
  LineReader lines(text);
  auto line = lines.next_filled();
  const int first = lines.number();
  if (line) {
    const auto tokens = split_tokens(*line);
    if (tokens.size() == 1) {
      count = parse_number<std::uint64_t>(tokens[0]);
      if (!count)
        return failure_at_line(path, first, fmt::format("expected a count, found {}", quote_token(tokens[0])));
    }
    if (count || is_column_header(tokens)) line = lines.next_filled();
  }
  for (; line; line = lines.next_filled()) {
    QUORUM_ASSIGN(auto view, parse_view(path, lines.number(), split_tokens(*line)));
    views.push_back(std::move(view));
  }
  if (count && *count != views.size())
    return failure_at_line(
        path, first,
        fmt::format("says {} views, but {} follow; complete the file or correct the count", *count, views.size()));
  return views;
}

std::string format_par_file(const std::vector<ParLine>& lines) {
  std::string text = fmt::format("{}\n", lines.size());
  for (const ParLine& line : lines) {
    text += line.image;
    for (const Eigen::Matrix3d& matrix : {line.camera.intrinsics, line.camera.camera_from_world})
      for (int i = 0; i < 9; ++i) text += fmt::format(" {:.17g}", matrix(i / 3, i % 3));
    for (const double value : line.camera.translation) text += fmt::format(" {:.17g}", value);
    text += '\n';
  }
  return text;
}

}  // namespace quorum
