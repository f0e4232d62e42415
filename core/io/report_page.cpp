#include "core/io/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/markdown.hpp"
#include "core/io/report.hpp"
#include "core/io/report_rows.hpp"

namespace signorini {
namespace {
using report::Json;
using report::KeySpec;
using report::Kind;
using report::ObjectSpec;

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::flag:
      return "true or false";
    case Kind::whole:
      return "whole number";
    case Kind::number:
      return "number";
    case Kind::text:
      return "text";
    case Kind::numbers:
      return "list of numbers";
    case Kind::texts:
      return "list of texts";
    case Kind::object:
      return "object";
    case Kind::objects:
      return "list of objects";
    case Kind::nothing:
      return "null";
  }
  return "";
}

std::string type_of(const KeySpec& key) {
  return fmt::format("{}{}{}", kind_name(key.kind), key.null ? ", or null" : "",
                     key.sometimes ? "; not always there" : "");
}

/// Whether a key means the same in the whole report.
bool is_of_report(const KeySpec& key) {
  return std::ranges::any_of(report::report_spec().keys,
                             [&](const KeySpec& top) { return top.name == key.name && top.help == key.help; });
}

/// Objects with where they stand, each once.
struct Section {
  std::string path;
  const ObjectSpec* object;
};

void add_sections(const ObjectSpec& object, const std::string& before, std::vector<Section>& all) {
  for (const KeySpec& key : object.keys) {
    if (!key.object || std::ranges::find(all, &key.object(), &Section::object) != all.end()) continue;
    const std::string path = before + key.name + (key.kind == Kind::objects ? "[]" : "");
    all.push_back({path, &key.object()});
    add_sections(key.object(), path + ".", all);
  }
}

std::string keys_table(const ObjectSpec& object, bool top) {
  std::string table = "| key | is | says |\n| --- | --- | --- |\n", shared;
  for (const KeySpec& key : object.keys)
    if (!top && is_of_report(key))
      shared += fmt::format("{}`{}`", shared.empty() ? "" : ", ", key.name);
    else
      table += fmt::format("| `{}` | {} | {} |\n", key.name, type_of(key), in_cell(key.help));
  return shared.empty() ? table : fmt::format("{}\nAnd as of the whole report: {}.\n", table, shared);
}

std::string sections_of(const ObjectSpec& object, std::vector<Section>& known) {
  const std::size_t first = known.size();
  add_sections(object, "", known);
  std::string text;
  for (std::size_t k = first; k < known.size(); ++k)
    text += fmt::format("\n### `{}`\n\n{}", known[k].path, keys_table(*known[k].object, false));
  return text;
}

constexpr const char* introduction_to_reports = R"md(# The report

<!-- Written by report_page(); a test compares. Do not edit. -->

`signorini solve` writes `report.json`. This prints the force on the first obstacle and the largest pressure there:

```sh
python3 -c 'import json; c = json.load(open("out/ball_axisymmetric/report.json"))["contact"][0]; print(c["force"], c["max_pressure"])'
```

- Numbers are in full precision. One that is not finite is `null`.
- Forces, lengths and energies are in the units of the scene. Forces and displacements have an entry per component; those of
  scalar bodies have one.
- Results come first, what the solver did comes last.
- Further versions add keys. One that goes is in the changelog.

[report.schema.json](report.schema.json) is a JSON schema of this version's reports. An installed copy is in
`share/signorini`:

```sh
python3 -m jsonschema -i report.json report.schema.json
```

## Keys

)md";

/// What the schema says of a value.
Json schema_of(const KeySpec& key) {
  const auto types = [&](const char* type, bool null) { return null ? Json{type, "null"} : Json(type); };
  const auto reference = [&] { return Json{{"$ref", "#/definitions/" + key.object().name}}; };
  Json schema = Json::object();
  switch (key.kind) {
    case Kind::flag:
      schema["type"] = types("boolean", key.null);
      break;
    case Kind::whole:
      schema["type"] = types("integer", key.null);
      break;
    case Kind::number:
      schema["type"] = types("number", true);
      break;
    case Kind::text:
      schema["type"] = types("string", key.null);
      break;
    case Kind::numbers:
      schema["type"] = "array";
      schema["items"] = {{"type", types("number", true)}};
      break;
    case Kind::texts:
      schema["type"] = "array";
      schema["items"] = {{"type", "string"}};
      break;
    case Kind::object:
      schema = key.null ? Json{{"anyOf", {reference(), {{"type", "null"}}}}} : reference();
      break;
    case Kind::objects:
      schema["type"] = "array";
      schema["items"] = reference();
      break;
    case Kind::nothing:
      schema["type"] = "null";
      break;
  }
  if (!schema.contains("$ref")) schema["description"] = key.help;  // beside it nothing counts
  return schema;
}

Json schema_of(const ObjectSpec& object) {
  Json properties = Json::object(), required = Json::array();
  for (const KeySpec& key : object.keys) {
    properties[key.name] = schema_of(key);
    if (!key.sometimes) required.push_back(key.name);
  }
  return {{"type", "object"}, {"additionalProperties", false}, {"required", required}, {"properties", properties}};
}

}  // namespace

std::string report_page() {
  std::vector<Section> known;
  std::string text = introduction_to_reports + keys_table(report::report_spec(), true);
  text += sections_of(report::report_spec(), known);
  text += "\n## The report of `signorini qp`\n\n`--report FILE` writes one without a scene:\n\n";
  text += keys_table(report::qp_spec(), false);
  return text + sections_of(report::qp_spec(), known);
}

std::string report_schema() {
  std::vector<Section> sections;
  add_sections(report::report_spec(), "", sections);
  add_sections(report::qp_spec(), "", sections);
  Json definitions = Json::object();
  for (const Section& section : sections) definitions[section.object->name] = schema_of(*section.object);
  definitions["qp"] = schema_of(report::qp_spec());
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "report.json of signorini"}};
  schema.update(schema_of(report::report_spec()));
  schema["definitions"] = std::move(definitions);
  return schema.dump(1) + '\n';
}

}  // namespace signorini
