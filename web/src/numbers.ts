// Numbers for people: enough digits and no more, powers of ten as they are printed.

const raised = (n: number) =>
  String(n).replace(/[-0-9]/g, (c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)]));

const minus = (text: string) => text.replace('-', '−');

/** `digits` significant digits; "0.0312", "3.96·10⁻¹¹". */
export function shown(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent >= -3 && exponent < 5) return minus(String(Number(value.toPrecision(digits))));
  const [mantissa, power] = value.toExponential(digits - 1).split('e');
  return `${minus(String(Number(mantissa)))}·10${raised(Number(power))}`;
}

/** As many digits as an error of `error` allows, at most six. */
export function shownWithin(value: number, error: number, digits = 6): string {
  if (error <= 0) return shown(value, digits);
  if (Math.abs(value) <= error) return '0';
  const known = Math.floor(Math.log10(Math.abs(value) / error)) + 1;
  return shown(value, Math.max(1, Math.min(digits, known)));
}

/** A power of ten, a multiple of three, that brings values of this size between 1 and 1000. */
export function thousands(size: number): number {
  if (!(size > 0) || !Number.isFinite(size)) return 0;
  const power = 3 * Math.floor(Math.log10(size) / 3);
  return power >= -3 && power < 3 && size >= 0.01 ? 0 : power;
}

/** "10⁻¹² m" */
export function unitWith(power: number, unit: string): string {
  if (power === 0) return unit;
  return `10${raised(power)}${unit ? ' ' + unit : ''}`;
}

export function seconds(value: number): string {
  if (value < 0.0995) return `${shown(value * 1000, 2)} ms`;
  if (value < 120) return `${shown(value, 3)} s`;
  return `${Math.floor(value / 60)} min ${Math.round(value % 60)} s`;
}

/** "von_mises" to "von Mises stress" */
export function fieldTitle(name: string): string {
  const titles: Record<string, string> = {
    displacement: 'Displacement', potential: 'Electric potential', temperature: 'Temperature',
    von_mises: 'von Mises stress', stress: 'Stress',
    recovered_von_mises: 'von Mises stress', recovered_stress: 'Stress',
    principal_stress: 'Principal stress', recovered_principal_stress: 'Principal stress',
    strain: 'Strain',
    electric_displacement: 'Electric displacement', electric_field: 'Electric field', heat_flux: 'Heat flux',
  };
  const plain = name.replace(/_/g, ' ');
  return titles[name] ?? plain.charAt(0).toUpperCase() + plain.slice(1);
}

export const symbols: Record<string, string> = {
  displacement: 'u', potential: 'φ', temperature: 'θ', von_mises: 'σ_vM', stress: 'σ',
  recovered_von_mises: 'σ_vM', recovered_stress: 'σ', principal_stress: 'σ', recovered_principal_stress: 'σ',
  strain: 'ε',
  electric_displacement: 'D', electric_field: 'E', heat_flux: 'q',
};
