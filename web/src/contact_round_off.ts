// Whether tractions and slips at the contact are more than round-off.
import { Result } from './results';

/** Sizes below this share of what they are computed from are what is left of the linear solve. */
const roundOff = 1e-11;

export interface ContactRoundOff { normal: boolean; tangential: boolean; slip: boolean; gap: boolean }

/** The greatest size in columns of contact.csv whose names begin so. */
function greatest(result: Result, begin: string): number {
  let most = 0;
  for (const name of result.contact!.names.filter((n) => n.startsWith(begin)))
    for (const v of result.contact!.column(name)!) most = Math.max(most, Math.abs(v));
  return most;
}

function greatestStress(result: Result): number {
  const stress = result.field('recovered_stress') ?? result.field('stress');
  return Math.max(0, ...(stress?.components ?? []).map((c) => {
    const { least, greatest } = stress!.values(c);
    return Math.max(-least, greatest);
  }));
}

/** Slips and openings up to this size [m] are round-off. */
export function negligibleMove(result: Result): number {
  const displacement = result.history?.column('max_displacement') ?? new Float32Array();
  return roundOff * displacement.reduce((most, v) => Math.max(most, v), 0);
}

/** Over all moments; tractions beside each other and the stresses in the body, slips and openings beside its displacements. */
export function contactRoundOff(result: Result): ContactRoundOff {
  const normal = greatest(result, 'normal_traction'), tangential = greatest(result, 'tangential_traction_');
  const slip = greatest(result, 'slip_'), gap = greatest(result, 'gap');
  const force = roundOff * Math.max(normal, tangential, greatestStress(result));
  const move = negligibleMove(result);
  return { normal: normal <= force, tangential: tangential <= force, slip: slip <= move, gap: gap <= move };
}
