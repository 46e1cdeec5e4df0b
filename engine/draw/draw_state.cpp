// SPDX-License-Identifier: Apache-2.0
#include "draw/draw_state.h"

#include "shared/scene_data.h"

namespace luxo {

std::optional<Inspection> inspectionOf(const DrawState& state) {
  switch (state.output) {
    case Output::Position:
      return Inspection{shared::kPosition, false};
    case Output::Normal:
      return Inspection{shared::kNormal, false};
    case Output::Uv:
      return Inspection{shared::kParameters, false};
    case Output::Depth:
      return Inspection{shared::kDepth, false};
    case Output::Id:
      return Inspection{shared::kId, false};
    case Output::Residual:
      return Inspection{shared::kResidual, false};
    case Output::Certificate:
      return Inspection{shared::kCertificate, false};
    case Output::Color:
      break;
  }
  switch (state.shading) {
    case Shading::Normal:
      return Inspection{shared::kNormal, true};
    case Shading::Uv:
      return Inspection{shared::kParameters, true};
    case Shading::Depth:
      return Inspection{shared::kDepth, true};
    case Shading::Id:
      return Inspection{shared::kId, true};
    case Shading::Residual:
      return Inspection{shared::kResidual, true};
    default:
      return std::nullopt;
  }
}

bool readsParameters(const DrawState& state) {
  if (state.surface) return false;  // a shell has them among its vertices
  return inspectionOf(state).has_value() || state.pattern.valid() ||
         state.form == Form::FoundWithParameters || state.form == Form::Layer || isAgain(state);
}

bool isFoundOnly(const DrawState& state) {
  return state.form == Form::Found || state.form == Form::FoundWithParameters;
}

bool addsMoreLight(const DrawState& state) {
  return state.form == Form::Again && state.addsLight && state.shading == Shading::Gouraud;
}

bool isAgain(const DrawState& state) { return state.form == Form::Again || state.form == Form::LayerAgain; }

bool isOfLayers(const DrawState& state) {
  using enum Form;
  switch (state.form) {
    case Layer:
    case LayerPlace:
    case LayerShadow:
    case LayerTransmittance:
    case LayersByRays:
    case ShadeLayers:
    case BlendLayers:
    case LayerLightMap:
    case LayerAgain:
      return true;
    default:
      return false;
  }
}

}  // namespace luxo
