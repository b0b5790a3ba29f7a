// Elements in one call.

type Child = Node | string | undefined | false;

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Record<string, unknown> = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (key.startsWith('on') && typeof value === 'function')
      node.addEventListener(key.slice(2), value as EventListener);
    else node.setAttribute(key, value === true ? '' : String(value));
  }
  node.append(...children.filter((c): c is Node | string => c !== undefined && c !== false));
  return node;
}

/** A labelled choice; `change` gets the chosen value. */
export function choice(label: string, options: [value: string, text: string][], chosen: string,
  change: (value: string) => void): { box: HTMLElement; select: HTMLSelectElement } {
  const select = element('select', { onchange: () => change(select.value) },
    ...options.map(([value, text]) => element('option', { value, selected: value === chosen }, text)));
  return { box: element('label', { class: 'control' }, element('span', {}, label), select), select };
}

/** A labelled box to tick. */
export function tick(label: string, on: boolean, change: (on: boolean) => void): HTMLLabelElement {
  const input = element('input', { type: 'checkbox', checked: on, onchange: () => change(input.checked) });
  return element('label', { class: 'tick' }, input, label);
}

/** A square in a legend. Its border is its colour, as backgrounds are not printed. */
export function swatch(colour: string): HTMLElement {
  return element('span', { class: 'swatch', style: `border-color:${colour}`, 'data-colour': colour });
}
