// SPDX-License-Identifier: Apache-2.0
// Builds the surfaces of a scene file, and the patterns and isolines of its materials: formulas of u, v and
// of those parameters that they use.
#pragma once

#include <optional>
#include <vector>

#include "base/diagnostic.h"
#include "scene/moment_formulas.h"
#include "scene/pattern.h"
#include "scene/scene_builder.h"
#include "scene/scene_variables.h"
#include "surface/displaced.h"
#include "surface/surface.h"

namespace luxo {

struct Cloth;

class ShapeBuilder {
 public:
  /// `warnings` may be null. `tangents`: meshes have them, where they have uvs.
  ShapeBuilder(const SceneVariables& variables, MomentFormulas& formulas, SceneProblems& problems,
               std::vector<Diagnostic>* warnings, WarningsAbout about, bool tangents)
      : variables_(variables),
        formulas_(formulas),
        problems_(problems),
        warnings_(warnings),
        about_(about),
        tangents_(tangents) {}

  /// No surface where something is wrong, which is then among the problems. Topology is that at time 0 with
  /// the parameters' initial values.
  [[nodiscard]] Surface build(const SurfaceDesc& surface);

  /// How a material displaces what it is on; nothing where it does not, or something is wrong.
  [[nodiscard]] std::optional<Displacement> buildDisplacement(const MaterialDesc& material);
  /// The surface of a file, displaced by a material. What is wrong with that is a problem at `place`.
  [[nodiscard]] Surface displace(const SurfaceDesc& desc, const Surface& surface,
                                 const MaterialDesc& material, const Displacement& displacement,
                                 FilePlace place);

  /// A colour and an opacity that may use u and v.
  struct MovingPaint {
    Pattern pattern;                                ///< where one really depends on them
    std::vector<Animated<double>> parameters = {};  ///< of the pattern
    Animated<Vec3> uniform = Vec3(0);               ///< of any other colour
    Animated<double> opacity = 1.0;                 ///< of any other opacity
    IsolineSet isolines = {};
    std::vector<Animated<double>> isolineParameters = {};
    Pattern curvature = {};  ///< of the surface, where a shader reads it
    std::vector<Animated<double>> curvatureParameters = {};
    bool readsSurface = false;  ///< and no surface was given: there is nothing else
    bool readsNames = false;    ///< with it: not only its range
  };
  /// The diffuse colour, opacity and isolines of a material. Constants are held against kLight and kFraction.
  /// `surface`: what names of scene/surface_names.h speak of, and where a grid of u and v is.
  [[nodiscard]] MovingPaint buildPaint(const MaterialDesc& material, const Surface& surface = {});

 private:
  class Formulas;

  Surface buildShape(const std::string& name, const NamedShape& shape);
  Surface buildShape(const std::string& name, const FormulaShape& shape);
  Surface buildShape(const std::string& name, const RevolveShape& shape);
  Surface buildShape(const std::string& name, const TubeShape& shape);
  Surface buildShape(const std::string& name, const BezierShape& shape);
  Surface buildShape(const std::string& name, const MeshShape& shape);
  Surface buildShape(const std::string& name, const ClothShape& shape);
  Surface buildShape(const std::string&, std::monostate) { return {}; }

  [[nodiscard]] bool readOpacity(const MaterialDesc& material, const Surface& surface,
                                 Animated<double>& value);
  std::uint32_t cellsOf(const Quantity& quantity);
  void addPins(const ClothPinDesc& pin, Cloth& cloth);
  void checkClosed(const FormulaShape& shape, const Surface& surface);
  /// `what`: the surface as messages call it.
  void warn(FilePlace place, const std::string& what, const Surface& surface);

  const SceneVariables& variables_;
  MomentFormulas& formulas_;
  SceneProblems& problems_;
  std::vector<Diagnostic>* warnings_;
  WarningsAbout about_;
  bool tangents_;
};

}  // namespace luxo
