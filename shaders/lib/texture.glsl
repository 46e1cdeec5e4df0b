// SPDX-License-Identifier: Apache-2.0
// The textures of a material, that of its colour as a pattern: filtered by luxo itself, as engine/scene/texture_map.h says,
// whose numbers the ground truth has in double. Where a texture's numbers start is `first`: draw/texture_list.h lists them.
// All texels of a picture's textures are in one buffer, level after level, row after row.
#include "shared/truth.h"

#ifndef LUXO_TEXELS_BINDING
#define LUXO_TEXELS_BINDING kBindingTexels
#endif
layout(set = kSetPattern, binding = LUXO_TEXELS_BINDING) uniform samplerBuffer texels;

// What sums of weights lose of an alpha of 1: 17 samples of 8 texels, each rounded by 2^-24.
const float kAlphaRounding = 1e-5;
const int kMaxMipLevels = 16;   // after the first: of images of 65,536 texels a side

struct TextureNumbers {
  vec2 size;
  float levels, anisotropy;
  int first;
  uint wrapU, wrapV;
};

struct TexelLevel {
  int first;
  ivec2 size;
};

vec2 numbers2At(uint k) { return vec2(parameterAt(k), parameterAt(k + 1)); }
vec3 numbers3At(uint k) { return vec3(numbers2At(k), parameterAt(k + 2)); }

TextureNumbers textureNumbers(uint first) {
  return TextureNumbers(numbers2At(first + kTextureSize), parameterAt(first + kTextureLevels),
                        parameterAt(first + kTextureAnisotropy),
                        65536 * int(parameterAt(first + kTextureFirst)) + int(parameterAt(first + kTextureFirst + 1)),
                        uint(parameterAt(first + kTextureWraps)), uint(parameterAt(first + kTextureWraps + 1)));
}

// Reduced to the part that wraps know: 0 to 1, or to 2.
float reduced(float x, uint wrap) {
  float period = wrap == kWrapMirror ? 2.0 : 1.0;
  return wrap == kWrapClamp ? clamp(x, -1.0, 2.0) : x - period * floor(x / period);
}

// Of an index that is at most one period off.
int wrapped(int i, int size, uint wrap) {
  int period = wrap == kWrapMirror ? 2 * size : size, inside = i < 0 ? i + period : i >= period ? i - period : i;
  return wrap == kWrapClamp ? clamp(i, 0, size - 1) : inside < size ? inside : period - 1 - inside;
}

TexelLevel firstLevel(TextureNumbers numbers) { return TexelLevel(numbers.first, ivec2(numbers.size)); }
TexelLevel nextLevel(TexelLevel level) {
  return TexelLevel(level.first + level.size.x * level.size.y, max(level.size / 2, ivec2(1)));
}

// Colours times alpha.
vec4 weighedTexel(TextureNumbers numbers, TexelLevel level, int x, int y) {
  vec4 texel = texelFetch(texels, level.first + wrapped(y, level.size.y, numbers.wrapV) * level.size.x +
                                      wrapped(x, level.size.x, numbers.wrapU));
  return vec4(texel.rgb * texel.a, texel.a);
}

vec2 inTexels(TextureNumbers numbers, TexelLevel level, vec2 place) {
  return vec2(reduced(place.x, numbers.wrapU), reduced(place.y, numbers.wrapV)) * vec2(level.size);
}

vec4 bilinear(TextureNumbers numbers, TexelLevel level, vec2 place) {
  vec2 at = inTexels(numbers, level, place) - 0.5, low = floor(at), part = at - low;
  int x = int(low.x), y = int(low.y);
  return mix(mix(weighedTexel(numbers, level, x, y), weighedTexel(numbers, level, x + 1, y), part.x),
             mix(weighedTexel(numbers, level, x, y + 1), weighedTexel(numbers, level, x + 1, y + 1), part.x), part.y);
}

vec4 nearestTexel(TextureNumbers numbers, vec2 place) {
  ivec2 at = ivec2(floor(inTexels(numbers, firstLevel(numbers), place)));
  return weighedTexel(numbers, firstLevel(numbers), at.x, at.y);
}

float stepOf(float x) { return abs(x) <= kMaxTextureStep ? x : kMaxTextureStep; }

vec4 filteredTexels(TextureNumbers numbers, vec2 place, mat2 steps) {
  for (int i = 0; i < 2; ++i) steps[i] = numbers.size * vec2(stepOf(steps[i].x), stepOf(steps[i].y));
  // The ellipse's axes, texels: the matrix's singular values, and where it takes the first's vector.
  float a = steps[0].x * steps[0].x + steps[1].x * steps[1].x, b = steps[0].x * steps[0].y + steps[1].x * steps[1].y,
        c = steps[0].y * steps[0].y + steps[1].y * steps[1].y;
  float half_ = 0.5 * (a - c), radius = sqrt(half_ * half_ + b * b), longer = sqrt(0.5 * (a + c) + radius);
  float shorter = abs(steps[0].x * steps[1].y - steps[0].y * steps[1].x) / max(longer, 1e-30);
  vec2 direction = half_ > 0.0 ? vec2(half_ + radius, b) : vec2(b, radius - half_);
  float size = length(direction);
  direction = size > 0.0 ? direction / size : vec2(1, 0);

  float width = max(max(shorter, longer / numbers.anisotropy), 1.0), len = max(longer / width, 1.0);
  float level = clamp(log2(width), 0.0, numbers.levels - 1.0);
  TexelLevel finer = firstLevel(numbers);
#ifdef LUXO_IN_LOOP
  // Inside a loop over a pixel's layers, whose neighbours have fewer, Mesa 22.3's llvmpipe gets a loop wrong that ends with
  // its level: at outlines colours were off by a tenth.
  for (int k = 0; k < kMaxMipLevels; ++k)
    if (k < int(level)) finer = nextLevel(finer);
#else
  for (int k = 0; k < int(level); ++k) finer = nextLevel(finer);
#endif
  TexelLevel coarser = nextLevel(finer);
  if (level >= numbers.levels - 1.0) coarser = finer;
  float part = level - floor(level);
  int side = int(ceil(0.5 * (len - 1.0)));
  vec4 sum = vec4(0);
  for (int k = -side; k <= side; ++k) {
    vec2 at = place + float(k) * width * direction / numbers.size;
    sum += clamp(0.5 * (len + 1.0) - abs(float(k)), 0.0, 1.0) *
           mix(bilinear(numbers, finer, at), bilinear(numbers, coarser, at), part);
  }
  return sum / len;
}

// With the alpha.
vec4 wholeTexelOfMap(uint first, vec2 parameters, vec4 footprint) {
  mat2 linear = mat2(numbers2At(first + kTextureLinear), numbers2At(first + kTextureLinear + 2));
  vec2 place = linear * parameters + numbers2At(first + kTextureConstant);
  TextureNumbers numbers = textureNumbers(first);
  vec4 color = parameterAt(first + kTextureNearest) != 0.0
                   ? nearestTexel(numbers, place)
                   : filteredTexels(numbers, place, linear * mat2(footprint.xy, footprint.zw));
  return vec4(color.a > 0.0 ? color.rgb / color.a : vec3(0), color.a > 1.0 - kAlphaRounding ? 1.0 : color.a);
}

// What floats may make of an alpha: of parameters they are told to within a few parts of 2^22, and are kept off the ends of
// their domain by a millionth of it, which moves the place; and of the level that a pixel takes.
const float kPlaceRounding = 1.90734863e-6, kLevelRounding = 2e-4;

float roundingOfAlpha(uint first, vec2 parameters) {
  TextureNumbers numbers = textureNumbers(first);
  mat2 linear = mat2(numbers2At(first + kTextureLinear), numbers2At(first + kTextureLinear + 2));
  vec2 constant = numbers2At(first + kTextureConstant);
  mat2 sizes = mat2(abs(linear[0]), abs(linear[1]));
  vec2 off = kPlaceRounding * numbers.size * (sizes * (abs(parameters) + 1.0) + abs(constant));  // texels
  if (parameterAt(first + kTextureNearest) == 0.0) return off.x + off.y + kLevelRounding;
  vec2 at = inTexels(numbers, firstLevel(numbers), linear * parameters + constant), beside = abs(at - round(at));
  return beside.x <= off.x || beside.y <= off.y ? 1.0 : kAlphaRounding;  // which texel it is, is open
}

vec4 wholeTexelOfMap(uint first, vec2 parameters) { return wholeTexelOfMap(first, parameters, pixelFootprint()); }
vec3 texelOfMap(uint first, vec2 parameters) { return wholeTexelOfMap(first, parameters).rgb; }

vec3 tintOfMap(uint first) { return numbers3At(first + kTextureTint); }

void patternPaint(float u, float v, out vec4 paint) {
  paint = vec4(tintOfMap(0), 1.0);
#ifdef LUXO_MAP_OPACITY
  paint *= wholeTexelOfMap(0, vec2(u, v));
#elif defined(LUXO_COLOR_MAP)
  paint.rgb *= texelOfMap(0, vec2(u, v));
#endif
}

#ifdef LUXO_NORMAL_MAP
mat3 normalFromTexel() {
  const uint k = LUXO_NORMAL_MAP + kTextureNumbers;
  return mat3(numbers3At(k), numbers3At(k + 3), numbers3At(k + 6));
}
#endif
