// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene/material.h"

namespace luxo {
namespace {

// A material has its own light; what shows the geometry shows all of it.
TEST(Shading, ViewsOfDataOverrideMaterials) {
  const Material toon{.shading = Shading::Toon}, plain;
  EXPECT_EQ(toon.shadingIn(Shading::Phong), Shading::Toon);
  EXPECT_EQ(plain.shadingIn(Shading::Phong), Shading::Phong);
  for (const Shading data : {Shading::Wireframe, Shading::Normal, Shading::Uv, Shading::Depth, Shading::Id}) {
    EXPECT_EQ(toon.shadingIn(data), data);
    EXPECT_EQ(plain.shadingIn(data), data);
  }
}

}  // namespace
}  // namespace luxo
