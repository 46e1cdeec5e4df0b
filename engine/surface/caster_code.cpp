// SPDX-License-Identifier: Apache-2.0
#include "surface/caster_code.h"

#include <algorithm>

namespace luxo {

CasterCode casterCode(SurfaceCodes& codes, const Surface& surface, std::span<const double> parameters) {
  if (surface.triangles()) return {codes.triangles(), {}};
  std::vector<SurfaceCodePtr> different;
  std::vector<std::size_t> codeOf;
  CasterCode found;
  std::size_t most = 0;
  for (const Patch& patch : surface.patches()) {
    const PatchInputs inputs(patch, parameters);
    const std::span<const double> own = inputs;
    const std::vector<double>& numbers =
        found.parameters.emplace_back(patch.general ? patch.general->inputs(patch.constants, parameters)
                                                    : std::vector<double>(own.begin(), own.end()));
    most = std::max(most, numbers.size());
    const SurfaceCodePtr code =
        patch.general ? codes.get(patch.general, numbers.size()) : codes.get(patch.function, numbers.size());
    codeOf.push_back(static_cast<std::size_t>(std::ranges::find(different, code) - different.begin()));
    if (codeOf.back() == different.size()) different.push_back(code);
  }
  if (different.size() == 1) {
    found.code = different[0];
    return found;
  }
  found.code = codes.united(different, most);
  for (std::size_t i = 0; i < codeOf.size(); ++i) {
    found.parameters[i].resize(most);
    found.parameters[i].push_back(static_cast<double>(codeOf[i]));
  }
  return found;
}

}  // namespace luxo
