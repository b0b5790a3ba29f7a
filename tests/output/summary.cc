#include "output/summary.h"

#include <gtest/gtest.h>

#include <limits>

namespace tourmaline::output {
namespace {

Summary whole_summary() {
  Summary summary;
  summary.title = "Insulated \"foundation\"";
  summary.version = "0.1.0";
  summary.components = {{"dealii", "9.4.1"}};
  summary.inputs = {{"body.msh", "00000000000000ff"}};
  summary.files = {{"history.csv", 77}};
  summary.sizes = {{"nodes", 4}, {"cells", 2}};
  summary.iterations = {{"newton_total", 20}, {"newton_max", 2}};
  summary.factorisations = 1;
  summary.negative_pivots = 8;
  summary.backward_error = 0.5;
  summary.forward_error = 0.25;
  summary.is_refined = true;
  summary.extremes = {{"potential", -0., 0.1, {0, 0.5, 0}, {1, -0., 0}}};
  summary.seconds.mesh = 0.25;
  summary.seconds.step = {.total = 2, .per_step = 0.125, .substitutions = 2, .estimates = 0.5};
  summary.peak_memory_bytes = 1 << 30;
  summary.warnings = {"coarse"};
  return summary;
}

TEST(SummaryText, ItHasTheKeysOfTheContractInTheirOrder) {
  EXPECT_EQ(summary_text(2, whole_summary()), R"({
  "case": "Insulated \"foundation\"",
  "versions": {
    "tourmaline": "0.1.0",
    "dealii": "9.4.1"
  },
  "inputs": {
    "body.msh": "00000000000000ff"
  },
  "files": {
    "history.csv": 77
  },
  "sizes": {
    "cells": 2,
    "nodes": 4
  },
  "iterations": {
    "newton_max": 2,
    "newton_total": 20
  },
  "factorisations": 1,
  "negative_pivots": 8,
  "backward_error": 0.5,
  "forward_error": 0.25,
  "refined": true,
  "extremes": [
    {
      "field": "potential",
      "minimum": 0.0,
      "at_minimum": [
        0.0,
        0.5
      ],
      "maximum": 0.1,
      "at_maximum": [
        1.0,
        0.0
      ]
    }
  ],
  "materials": [],
  "seconds": {
    "mesh": 0.25,
    "start": null,
    "assemble": null,
    "analyse": null,
    "factorise": null,
    "condense": null,
    "step": {
      "total": 2.0,
      "per_step": 0.125,
      "substitutions": 2.0,
      "contact": null,
      "estimates": 0.5
    },
    "output": null,
    "total": null
  },
  "memory": 1073741824,
  "warnings": [
    "coarse"
  ]
}
)");
}

TEST(SummaryText, WhatIsNotKnownOrNotFiniteIsNull) {
  Summary summary;
  summary.seconds.output = std::numeric_limits<double>::infinity();
  const std::string text = summary_text(2, summary);
  for (const char *key : {"negative_pivots", "backward_error", "output", "total"})
    EXPECT_NE(text.find("\"" + std::string(key) + "\": null"), std::string::npos) << key;
  for (const char *empty : {"\"sizes\": {}", "\"extremes\": []", "\"warnings\": []"})
    EXPECT_NE(text.find(empty), std::string::npos) << empty;
}

TEST(SummaryText, ATitleInAnotherEncodingDoesNotLoseTheSummary) {
  Summary summary;
  summary.title = "Ouafik \xe9";
  EXPECT_NE(summary_text(2, summary).find("\"case\": \"Ouafik \xef\xbf\xbd\""), std::string::npos);
}

TEST(SummaryText, PlacesHaveThreeCoordinatesInThreeDimensions) {
  Summary summary;
  summary.extremes = {{"temperature", 0, 1, {0, 0, 0.5}, {0, 0, 2}}};
  EXPECT_NE(summary_text(3, summary).find("0.5\n"), std::string::npos);
  EXPECT_EQ(summary_text(2, summary).find("0.5\n"), std::string::npos);
}

}  // namespace
}  // namespace tourmaline::output
