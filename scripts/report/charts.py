# SPDX-License-Identifier: MIT
"""The charts by the names that study files use."""
from dataclasses import dataclass
from typing import Callable

from . import ensemble_charts, error_charts, needs_charts


@dataclass(frozen=True)
class Chart:
    draw: Callable  # of results, a scene (index) where it is of one, and a metric where it is of one: a Drawing, or None where there is nothing for it
    of: str = "scene"  # "metric": one for each scene and metric; "scene": one for each scene; "count": one for each scene, metric and
    # count; "counts": one for each count over all scenes; "study": one for each metric over all scenes; "whole": one


ERROR = {
    "error_vs_time": Chart(error_charts.error_vs_time, "metric"),
    "error_vs_rays": Chart(error_charts.error_vs_rays, "metric"),
    "error_vs_frame": Chart(error_charts.error_vs_frame, "metric"),
    "time_vs_frame": Chart(error_charts.time_vs_frame),
    "frontier": Chart(error_charts.frontier, "metric"),
    "time_by_pass": Chart(error_charts.time_by_pass),
    "rays_by_pass": Chart(error_charts.rays_by_pass),
    "rays_by_purpose": Chart(error_charts.rays_by_purpose),
    "stability": Chart(error_charts.stability, "metric"),
    "comparison": Chart(error_charts.comparison, "metric"),
    "ablation": Chart(error_charts.ablation, "metric"),
    "bias_variance": Chart(error_charts.bias_variance, "metric"),
    "stability_matrix": Chart(error_charts.stability_matrix, "study"),
    "error_vs_count": Chart(needs_charts.error_vs_count, "count"),
    "needs": Chart(needs_charts.needs, "count"),
    "advantage": Chart(needs_charts.advantage, "metric"),
    "cost_vs_model": Chart(needs_charts.cost_vs_model, "counts"),
    "outcomes": Chart(error_charts.outcomes, "whole"),
}
ENSEMBLE = {
    "energy": Chart(ensemble_charts.energy),
    "blocks": Chart(ensemble_charts.blocks),
    "convergence": Chart(ensemble_charts.convergence),
    "power": Chart(ensemble_charts.power),
}
