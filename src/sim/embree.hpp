// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// Embree 3 (Debian 12, Ubuntu 22.04) and 4 (Debian 13, Ubuntu 24.04) under the names of 4.
#if NVM_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace nvm::sim {

#if NVM_EMBREE_VERSION >= 4
using EmbreeQuery = RTCRayQueryContext;

inline EmbreeQuery make_embree_query() {
  EmbreeQuery query;
  rtcInitRayQueryContext(&query);
  return query;
}

inline void intersect(RTCScene scene, EmbreeQuery& query, RTCRayHit& ray_hit) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query;
  rtcIntersect1(scene, &ray_hit, &arguments);
}
#else
using EmbreeQuery = RTCIntersectContext;

inline EmbreeQuery make_embree_query() {
  EmbreeQuery query;
  rtcInitIntersectContext(&query);
  return query;
}

inline void intersect(RTCScene scene, EmbreeQuery& query, RTCRayHit& ray_hit) {
  rtcIntersect1(scene, &query, &ray_hit);
}
#endif

}  // namespace nvm::sim
