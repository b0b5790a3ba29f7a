// Whether triangle and weights of a place on one body are those of the same place on another.
import { Body } from './body';

export function isSameMesh(one: Body, other: Body): boolean {
  const a = one.grid, b = other.grid;
  return a === b || (a.triangles.length === b.triangles.length && a.points.length === b.points.length &&
    a.triangles.every((v, i) => v === b.triangles[i]) && a.points.every((v, i) => Math.abs(v - b.points[i]) <= 1e-6 * one.size));
}
