#include "core/component/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstring>
#include <iterator>
#include <map>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/base/error.hpp"
#include "core/input/field.hpp"
#include "core/input/values.hpp"
#include "core/sdk/obstacle.hpp"

namespace signorini {
namespace {

// The typed value of an option; a field is a list of one.
using Value = std::variant<std::monostate, bool, long, double, std::string, std::vector<Field>>;

Value typed(const RawValue& raw, const OptionSpec& spec) {
  switch (spec.type) {
    case OptionType::boolean:
      return to_flag(raw);
    case OptionType::integer:
      return static_cast<long>(to_integer(raw, spec.range));
    case OptionType::number:
      return to_number(raw, spec.range);
    case OptionType::text:
      return to_text(raw, spec.range);
    case OptionType::field:
      return std::vector<Field>{to_field(raw, spec.range)};
    case OptionType::vector:
      return to_fields(raw, spec.range);
  }
  return {};
}

RawValue scalar_value(std::string_view text, OptionType type, const std::string& origin) {
  if (type == OptionType::text) return {std::string(text), origin};
  if (type == OptionType::boolean && (text == "true" || text == "false")) return {text == "true", origin};
  if (type == OptionType::integer) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.begin(), text.end(), number);
    if (error == std::errc() && end == text.end()) return {number, origin};
  }
  return {std::string(text), origin};  // numbers may be expressions
}

// A text as if a user had written that value in a scene. A vector is "[a, b, c]", its entries without commas.
RawValue value_of(std::string_view text, OptionType type, const std::string& origin) {
  if (type != OptionType::vector) return scalar_value(text, type, origin);
  RawValue::List list;
  if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    list.push_back({std::string(text.substr(0, comma)), origin});
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return {list, origin};
}

RawValue default_value(const OptionSpec& spec, const std::string& component) {
  return value_of(spec.fallback, spec.type, fmt::format("default of '{}' of {}", spec.name, component));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  return first == text.npos ? std::string_view() : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

void reject_unknown_keys(const std::string& component, std::span<const OptionSpec> specs, const RawTable& given,
                         std::span<const std::string> other_keys) {
  std::vector<std::string> valid(other_keys.begin(), other_keys.end());
  for (const OptionSpec& spec : specs) valid.emplace_back(spec.name);
  for (const auto& [key, raw] : given.entries) {
    bool known = false;
    for (const OptionSpec& spec : specs) known = known || key == spec.name;
    if (!known)
      input_error(raw.origin, fmt::format("{} has no option '{}'{}", component, key, did_you_mean(key, valid)));
  }
}

class CompiledSettings final : public Settings {
 public:
  CompiledSettings(const std::string& component, std::span<const OptionSpec> specs, const RawTable& given,
                   std::shared_ptr<const DistanceFunction> shape, double t)
      : component_(component), shape_(std::move(shape)), t_(t) {
    for (const OptionSpec& spec : specs) {
      const RawValue* raw = given.find(spec.name);
      Option& option = options_[spec.name];
      option.type = spec.type;
      option.given = raw != nullptr;
      if (raw)
        option.value = typed(*raw, spec);
      else if (*spec.fallback)
        option.value = typed(default_value(spec, component), spec);
    }
  }

  /// What was wrong with an option that was asked for; "" for nothing.
  std::string complaint() const {
    if (!wrong_) return {};
    if (options_.contains(wrong_name_))
      return fmt::format("the plugin of {} asks for its option '{}' as if it were of another type", component_,
                         wrong_name_);
    std::vector<std::string> names;
    for (const auto& [name, option] : options_) names.push_back(name);
    return fmt::format("the plugin of {} asks for an option '{}' that is not in its table{}", component_, wrong_name_,
                       did_you_mean(wrong_name_, names));
  }

  bool has(const char* name) const noexcept override {
    const auto found = options_.find(name);
    if (found == options_.end()) remember_wrong(name);
    return found != options_.end() && found->second.given;
  }
  bool flag(const char* name) const noexcept override { return get<bool>(name); }
  long integer(const char* name) const noexcept override { return get<long>(name); }
  double number(const char* name) const noexcept override { return get<double>(name); }
  const char* text(const char* name) const noexcept override { return get<std::string>(name).c_str(); }
  std::size_t length(const char* name) const noexcept override { return get<std::vector<Field>>(name).size(); }
  const DistanceFunction* shape() const noexcept override { return shape_.get(); }

  bool constant(const char* name, double& value) const noexcept override {
    const auto& fields = get<std::vector<Field>>(name);
    if (fields.size() != 1 || !fields[0].constant()) return false;
    value = *fields[0].constant();
    return true;
  }

  double value(const char* name, std::size_t k, const double* point, const double* normal,
               Status& status) const noexcept override {
    double out = 0;
    guard(status, [&] { out = entry(name, k)(site(point, normal)); });
    return out;
  }

  void values(const char* name, const SurfaceVertex* vertices, std::size_t count, double* out,
              Status& status) const noexcept override {
    guard(status, [&] {
      const Field& field = entry(name, 0);
      Site sites[64];
      for (std::size_t first = 0; first < count; first += std::size(sites)) {
        const std::size_t some = std::min(std::size(sites), count - first);
        for (std::size_t k = 0; k < some; ++k)
          sites[k] = site(vertices[first + k].position, vertices[first + k].normal);
        field.values({sites, some}, out + first);
      }
    });
  }

 private:
  template <class Evaluate>
  static void guard(Status& status, const Evaluate& evaluate) noexcept {
    try {
      evaluate();
    } catch (const Error& error) {
      status.fail(static_cast<int>(error.status()), error.what());
    } catch (const std::exception& error) {
      status.fail(static_cast<int>(Exit::input), error.what());
    }
  }

  const Field& entry(const char* name, std::size_t k) const {
    const auto& fields = get<std::vector<Field>>(name);
    if (k < fields.size()) return fields[k];
    if (const std::string wrong = complaint(); !wrong.empty()) throw Error(Exit::plugin, wrong);
    throw Error(Exit::input,
                fmt::format("value {} of option '{}' was asked for, which has {}", k + 1, name, fields.size()));
  }

  Site site(const double* point, const double* normal) const {
    return {{point[0], point[1], point[2]}, {normal[0], normal[1], normal[2]}, t_};
  }

  struct Option {
    OptionType type = OptionType::text;
    bool given = false;
    Value value;
  };

  template <class T>
  static bool reads_as(OptionType type) noexcept {
    switch (type) {
      case OptionType::boolean:
        return std::is_same_v<T, bool>;
      case OptionType::integer:
        return std::is_same_v<T, long>;
      case OptionType::number:
        return std::is_same_v<T, double>;
      case OptionType::text:
        return std::is_same_v<T, std::string>;
      case OptionType::field:
      case OptionType::vector:
        return std::is_same_v<T, std::vector<Field>>;
    }
    return false;
  }

  // An option without value or default reads as zero or empty. Names and types come from the component's own table, so
  // anything else is a bug of the component, for check_asked(), whether the user gave the option or not.
  template <class T>
  const T& get(const char* name) const noexcept {
    static const T nothing{};
    const auto found = options_.find(name);
    if (found == options_.end() || !reads_as<T>(found->second.type)) {
      remember_wrong(name);
      return nothing;
    }
    const T* value = std::get_if<T>(&found->second.value);
    return value ? *value : nothing;
  }

  void remember_wrong(const char* name) const noexcept {
    if (!wrong_.exchange(true)) std::strncpy(wrong_name_, name, sizeof wrong_name_ - 1);
  }

  std::string component_;
  mutable std::atomic<bool> wrong_ = false;
  mutable char wrong_name_[64] = {};  // the first wrong option asked for: what is noexcept keeps it without memory
  std::map<std::string, Option, std::less<>> options_;
  std::shared_ptr<const DistanceFunction> shape_;
  double t_;
};

}  // namespace

std::shared_ptr<const Settings> compile_settings(const std::string& component, std::span<const OptionSpec> specs,
                                                 const RawTable& given, std::span<const std::string> other_keys,
                                                 std::shared_ptr<const DistanceFunction> shape, double t) {
  reject_unknown_keys(component, specs, given, other_keys);
  return std::make_shared<CompiledSettings>(component, specs, given, std::move(shape), t);
}

RawTable table_of(const std::string& component, std::span<const OptionSpec> specs,
                  std::span<const std::string> assignments) {
  RawTable out{component, {}};
  for (const std::string& text : assignments) {
    const std::string origin = fmt::format("{}: '{}'", component, text);
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) input_error(origin, "expected KEY=VALUE");
    const std::string key(trimmed(std::string_view(text).substr(0, equals)));
    const auto spec = std::ranges::find_if(specs, [&](const OptionSpec& one) { return key == one.name; });
    const OptionType type = spec == specs.end() ? OptionType::text : spec->type;  // what is unknown is refused later
    out.entries.emplace_back(key, value_of(trimmed(std::string_view(text).substr(equals + 1)), type, origin));
  }
  return out;
}

void check_asked(const Settings& settings, std::string_view origin) {
  const auto* compiled = dynamic_cast<const CompiledSettings*>(&settings);
  if (const std::string wrong = compiled ? compiled->complaint() : ""; !wrong.empty())
    throw Error(Exit::plugin, origin.empty() ? wrong : fmt::format("{}: {}", origin, wrong));
}

}  // namespace signorini
