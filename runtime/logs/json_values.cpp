// SPDX-License-Identifier: MIT
#include "runtime/logs/json_values.h"

#include <fmt/format.h>

#include <stdexcept>

#include "runtime/logs/json_log.h"
#include "runtime/logs/log_error.h"

#ifdef DYNGEN_LOGS_WITH_JSON
#include "runtime/logs/json_walk.h"
#endif

namespace dyngen::runtime {

std::string plain_json(std::string_view text) {
  std::string plain;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text && c == '\\' && i + 1 < text.size()) {
      plain += c;
      plain += text[++i];
      continue;
    }
    if (c == '"') in_text = !in_text;
    if (!in_text) {
      std::string_view rest = text.substr(i);
      const std::size_t sign = c == '-' ? 1 : 0;
      rest.remove_prefix(sign);
      const std::size_t size = rest.starts_with("NaN")        ? 3
                               : rest.starts_with("nan")      ? 3
                               : rest.starts_with("Infinity") ? 8
                                                              : 0;
      if (size > 0) {
        plain += "null";
        i += sign + size - 1;
        continue;
      }
    }
    plain += c;
  }
  return plain;
}

#ifdef DYNGEN_LOGS_WITH_JSON

namespace {

class JsonReader final : public MessageReader {
 public:
  void read(std::string_view bytes, FieldSink& sink) override {
    JsonRowWalk walk(sink);
    walk_json(bytes, walk);
  }
};

}  // namespace

std::unique_ptr<MessageReader> json_message_reader() { return std::make_unique<JsonReader>(); }

#else

std::unique_ptr<MessageReader> json_message_reader() {
  throw std::runtime_error("reading JSON needs nlohmann-json3-dev when dynid is built");
}

std::unique_ptr<RawLog> open_json_log(const std::function<ByteSource()>&, const std::string& name) {
  throw absent_package(name, "JSON files", "nlohmann-json3-dev");
}

#endif

}  // namespace dyngen::runtime
