// SPDX-License-Identifier: Apache-2.0
// Rays that a material's shader sends into the scene.
//
// The host casts them, in double, as the reference casts the eye's: so a shader is run again and again. Each time it gets
// the answers that there are, and asks for the first that is not there yet, which is all that this run is good for; until
// a run asks for none. An answer counts only for the ray that it was given to.
#ifndef LUXO_LIB_TRACE_GLSL
#define LUXO_LIB_TRACE_GLSL
#extension GL_GOOGLE_include_directive : require

#ifdef LUXO_SHADES_FOUND
layout(scalar, set = kSetFound, binding = kBindingTraceQuestions) writeonly buffer TraceQuestions {
  TraceQuestion traceQuestions[];
};
layout(scalar, set = kSetFound, binding = kBindingTraceStarts) readonly buffer TraceStarts { uint traceStarts[]; };
layout(scalar, set = kSetFound, binding = kBindingTraceAnswers) readonly buffer TraceAnswers { TraceAnswer traceAnswers[]; };

uint traceCount, tracePixel;
TraceQuestion traceOpen;

void beginTraces() {
  traceCount = 0;
  tracePixel = uint(gl_FragCoord.y) * uint(textureSize(foundTexels, 0).x) + uint(gl_FragCoord.x);
  traceOpen.ray.from = kNoQuestion;
}

bool tracesTooOften() { return traceCount > kMaxTraces; }

// At the end. Where something is open, the colour is that of a scene in which this ray, and those after it, meet nothing.
void askTraces() { traceQuestions[tracePixel] = traceOpen; }

Hit noHit() { return Hit(false, false, 1e30, vec3(0), vec3(0), vec2(0), vec3(0), 0); }

Hit answered(TraceAnswer answer, uint number) {
  return Hit(answer.distance >= 0.0, answer.inside != 0, answer.distance >= 0.0 ? answer.distance : 1e30,
             answer.position + shaderNumbers3(kShaderOrigin), answer.normal, answer.parameters, answer.color, number);
}

Hit traced(uint from, vec3 direction) {
  float size = length(direction);
  if (!(size > 0.0) || isinf(size) || traceOpen.ray.from != kNoQuestion || tracesTooOften()) return noHit();
  TraceRay ray = TraceRay(direction / size, from);
  uint first = traceStarts[tracePixel], index = traceCount++;
  if (tracesTooOften()) return noHit();
  if (first + index < traceStarts[tracePixel + 1]) {
    TraceAnswer answer = traceAnswers[first + index];
    if (answer.ray.from == from && answer.ray.direction == ray.direction) return answered(answer, kFromFirstHit + index);
  }
  traceOpen = TraceQuestion(ray, index, litPoint.position);
  return noHit();
}

Hit trace(vec3 direction) { return traced(kFromPoint, direction); }
// From nothing there is no way on.
Hit trace(Hit from, vec3 direction) {
  if (!from.found) return noHit();
  return traced(from.number, direction);
}
#else
#error "rays of shaders start at points that were found before"
#endif
#endif
