// Makes options, a line each: from a name, a member, a range and a help text.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/option.h"
#include "engine/core/parse_number.h"

namespace quorum {

/// Text of a number, as short as it can be read back.
template <typename Number>
std::string shortest_text(Number number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), number).ptr};
}

/// A number as it would be typed: 0.99 of the float that is nearest to it.
template <typename Number>
double as_typed(Number number) {
  if constexpr (std::is_same_v<Number, float>)
    return parse_number<double>(shortest_text(number)).value_or(NAN);
  else
    return static_cast<double>(number);
}

/// Makes options of one struct. member: a function from the struct, const or not, to the member: QUORUM_MEMBER.
template <typename Options>
struct OptionMaker {
  template <typename Member>
  using Value = std::remove_cvref_t<std::invoke_result_t<Member, Options&>>;

  /// A number in a range.
  template <typename Member>
  static Option<Options> number(std::string name, Member member, OptionRange range, std::string help) {
    Option<Options> option = plain(std::move(name), range.text(), std::move(help));
    option.parse = [member, range, self = option](Options& options, const std::vector<std::string>& words) {
      const auto number = parse_number<Value<Member>>(words[0]);
      if (!number || !range.holds(as_typed(*number))) return Expected<void>(self.refuse(words[0]));
      member(options) = *number;
      return Expected<void>();
    };
    option.text = [member](const Options& options) { return shortest_text(member(options)); };
    option.holds = [member, range](const Options& options) { return range.holds(as_typed(member(options))); };
    return option;
  }

  /// A number in a range, or auto, which empties the std::optional.
  template <typename Member>
  static Option<Options> number_or_auto(std::string name, Member member, OptionRange range, std::string help) {
    using Number = typename Value<Member>::value_type;
    Option<Options> option = plain(std::move(name), range.text() + ", or auto", std::move(help));
    option.parse = [member, range, self = option](Options& options, const std::vector<std::string>& words) {
      const auto number = parse_number<Number>(words[0]);
      if (words[0] != "auto" && (!number || !range.holds(as_typed(*number))))
        return Expected<void>(self.refuse(words[0]));
      member(options) = words[0] == "auto" ? std::nullopt : number;
      return Expected<void>();
    };
    option.text = [member](const Options& options) {
      return member(options) ? shortest_text(*member(options)) : std::string("auto");
    };
    option.holds = [member, range](const Options& options) {
      return !member(options) || range.holds(as_typed(*member(options)));
    };
    return option;
  }

  /// A length in scene units; 0 is auto.
  template <typename Member>
  static Option<Options> length(std::string name, Member member, std::string help) {
    return measure(std::move(name), member, "a positive length such as 0.0025 or 2.5mm, or auto", std::move(help),
                   parse_length);
  }
  /// Lengths in scene units, in one word, joined by commas.
  template <typename Member>
  static Option<Options> lengths(std::string name, Member member, std::string help) {
    Option<Options> option = plain(std::move(name), "positive lengths such as 0.25mm,0.5mm", std::move(help));
    option.is_list = true;
    option.parse = [member, self = option](Options& options, const std::vector<std::string>& words) {
      member(options).clear();
      for (std::size_t begin = 0; begin <= words[0].size();) {
        const std::size_t end = std::min(words[0].find(',', begin), words[0].size());
        const auto length = parse_length(std::string_view(words[0]).substr(begin, end - begin));
        if (!length || *length == 0.0) return Expected<void>(self.refuse(words[0]));
        member(options).push_back(*length);
        begin = end + 1;
      }
      return Expected<void>();
    };
    option.text = [member](const Options& options) {
      std::string list;
      for (const double length : member(options)) {
        if (!list.empty()) list += ',';
        list += shortest_text(length);
      }
      return list;
    };
    return option;
  }
  /// A size of memory in bytes; 0 is auto.
  template <typename Member>
  static Option<Options> size(std::string name, Member member, std::string help) {
    return measure(std::move(name), member, "a size such as 512MiB or 4GiB, or auto", std::move(help), parse_size);
  }

  /// One of some values by its name.
  template <typename Member>
  static Option<Options> choice(std::string name, Member member,
                                std::vector<std::pair<std::string_view, Value<Member>>> choices, std::string help) {
    std::string values;
    for (std::size_t i = 0; i < choices.size(); ++i)
      values += std::string(i == 0 ? "" : i + 1 < choices.size() ? ", " : " or ") + std::string(choices[i].first);
    Option<Options> option = plain(std::move(name), std::move(values), std::move(help));
    option.parse = [member, choices, self = option](Options& options, const std::vector<std::string>& words) {
      for (const auto& [known, value] : choices) {
        if (known != words[0]) continue;
        member(options) = value;
        return Expected<void>();
      }
      return Expected<void>(self.refuse(words[0]));
    };
    option.text = [member, choices](const Options& options) {
      for (const auto& [known, value] : choices)
        if (value == member(options)) return std::string(known);
      return std::string();
    };
    return option;
  }

  /// A switch. One that is on by default is given as no-NAME.
  template <typename Member>
  static Option<Options> toggle(std::string name, Member member, std::string help) {
    const Options defaults{};
    Option<Options> option = plain(std::move(name), "", std::move(help));
    option.least_words = option.most_words = 0;
    option.turns_off = member(defaults);
    option.parse = [member, on = !member(defaults)](Options& options, const std::vector<std::string>&) {
      member(options) = on;
      return Expected<void>();
    };
    option.text = [member](const Options& options) { return std::string(member(options) ? "true" : "false"); };
    return option;
  }

  /// Any text: a name, a file or a folder.
  template <typename Member>
  static Option<Options> text(std::string name, Member member, std::string values, std::string help) {
    Option<Options> option = plain(std::move(name), std::move(values), std::move(help));
    option.parse = [member](Options& options, const std::vector<std::string>& words) {
      member(options) = words[0];
      return Expected<void>();
    };
    option.text = [member](const Options& options) {
      if constexpr (std::is_same_v<Value<Member>, std::filesystem::path>)
        return member(options).string();
      else
        return member(options);
    };
    return option;
  }

  /// The rest: parse and text are to be set.
  static Option<Options> plain(std::string name, std::string values, std::string help) {
    Option<Options> option;
    option.name = std::move(name);
    option.values = std::move(values);
    option.help = std::move(help);
    return option;
  }

 private:
  template <typename Member, typename Parse>
  static Option<Options> measure(std::string name, Member member, std::string values, std::string help, Parse parse) {
    Option<Options> option = plain(std::move(name), std::move(values), std::move(help));
    option.parse = [member, parse, self = option](Options& options, const std::vector<std::string>& words) {
      const auto value = parse(words[0]);
      if (!value) return Expected<void>(self.refuse(words[0]));
      member(options) = *value;
      return Expected<void>();
    };
    option.text = [member](const Options& options) {
      return member(options) > 0 ? shortest_text(member(options)) : std::string("auto");
    };
    option.holds = [member](const Options& options) {
      const auto value = static_cast<double>(member(options));
      return value >= 0 && value < 0x1p60;
    };
    return option;
  }
};

}  // namespace quorum

/// A function from a struct of options to one of its members.
// NOLINTBEGIN(bugprone-macro-parentheses): the path of a member takes none
#define QUORUM_MEMBER(path) \
  [](auto& of_options) -> auto& { return of_options.path; }
// NOLINTEND(bugprone-macro-parentheses)
