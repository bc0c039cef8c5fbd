// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/left_out_json.h"

namespace dyngen::runtime {

Json written_back_json(const WrittenBack& made) {
  Json left_out = Json::array();
  for (const LeftOut& one : made.result.left_out) {
    left_out.push_back({{"what", one.what},
                        {"reason", one.reason},
                        {"rms", one.rms.size() > 0 ? numbers(one.rms) : Json(nullptr)}});
  }
  return {{"file", made.path},
          {"of", made.description},
          {"form", made.result.form},
          {"left_out", std::move(left_out)},
          {"notes", made.result.notes}};
}

}  // namespace dyngen::runtime
