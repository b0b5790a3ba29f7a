// Puts the page together.
import 'uplot/dist/uPlot.min.css';
import './style.css';
import { Body } from './body';
import { bothInOne } from './both_in_one';
import { redrawMarks } from './chart';
import { mapsNamed } from './colour_maps';
import { useColourMaps } from './colours';
import { Contact } from './contact';
import { ContactFace } from './contact_face';
import { element } from './dom';
import { Explorer } from './explorer';
import { History } from './history';
import { playback } from './playback';
import { probes } from './probes';
import { Overview } from './overview';
import { load, Result } from './results';
import { inBrief, runSection, warnings } from './run';
import { coloursOf, groupsOf } from './setting';
import { obstacle } from './stage';
import { startTheme, onTheme, toggleTheme } from './theme';
import { Timeline } from './timeline';

const { results, colourMaps } = load();
useColourMaps(colourMaps);

const page = document.getElementById('page')!;
const drawn = results.filter((r) => r.grid);
const several = results.length > 1;

function section(id: string, title: string, ...content: (HTMLElement | false)[]): HTMLElement {
  return element('section', { id, 'aria-labelledby': `${id}-title` }, element('h2', { id: `${id}-title` }, title), ...content);
}

/** The same part of each result, side by side where there is room. */
function beside(make: (result: Result) => HTMLElement | false): HTMLElement {
  return element('div', { class: `beside beside-${results.length}` }, ...results.map((result) => element('div', {},
    several && element('h3', { class: 'whose' }, result.title), make(result))));
}

function header(): HTMLElement {
  const titles = results.map((r) => element('div', {}, element('h1', {}, r.title), element('p', { class: 'brief' }, inBrief(r))));
  return element('header', {}, element('div', { class: `beside beside-${results.length}` }, ...titles),
    element('button', { type: 'button', id: 'theme', 'aria-label': 'light or dark', onclick: toggleTheme }, '◐'));
}

function notices(): HTMLElement | false {
  const texts = results.flatMap((r) => warnings(r).map((w) => (several ? `${r.name}: ${w}` : w)));
  const why = drawn.length > 0 ? obstacle() : '';
  if (why) texts.unshift(why);
  return texts.length > 0 && element('ul', { class: 'notices', role: 'status' }, ...texts.map((t) => element('li', {}, t)));
}

document.title = results.map((r) => r.title).join(' | ');
const longest = results.reduce((a, b) => (b.times.length > a.times.length ? b : a));
const timeline = new Timeline(longest.times, longest.grid ? longest.steps : [...(longest.history?.column('step') ?? [])]);
startTheme();
page.append(header(), ...[notices()].filter((n): n is HTMLElement => !!n));

const onMap: (() => void)[] = [];
if (drawn.length > 0 && !obstacle()) {
  const bodies = drawn.map((r) => new Body(r));
  const explorer = new Explorer(bodies, timeline);
  const pick = (field: string) => {
    explorer.choose(field);
    document.getElementById('fields')!.scrollIntoView({ behavior: 'smooth' });
  };
  bodies.forEach((body) => { if (body.result.dimension === 3) body.paintBoundaries(coloursOf(groupsOf(body.result))); });
  const overviews = bodies.map((body) => new Overview(body, timeline, pick));
  page.append(section('overview', 'At a glance', ...overviews.map((o, i) => element('div', {},
    several && element('h3', { class: 'whose' }, drawn[i].title), o.box))),
    section('fields', 'Fields', explorer.box));
  const all = () => { for (const overview of overviews) overview.draw(); explorer.refresh(); };
  timeline.onChange(() => { for (const overview of overviews) overview.move(); explorer.refresh(); });
  onTheme(all);
  const { display } = explorer;
  let map = '';
  const useMap = () => {
    if (map === display.map) return;
    map = display.map;
    useColourMaps(mapsNamed(display.map, colourMaps));
    all();
    for (const listener of onMap) listener();
  };
  display.onChange(useMap);
  useMap();
}

const touching = results.filter((r) => r.contact && r.contact.rows > 0);
if (touching.length > 0) {
  const contacts = new Map(touching.map((r, i) =>
    [r, r.dimension === 2 ? new Contact(r, timeline, String(i)) : new ContactFace(r, timeline)] as const));
  page.append(section('contact', 'Along the contact', beside((r) => !!contacts.get(r) &&
    element('div', {}, ...contacts.get(r)!.groups))));
  const update = () => { for (const contact of contacts.values()) contact.update(); };
  timeline.onChange(update);
  onMap.push(update);
}
if (results.some((r) => r.history)) {
  page.append(section('history', 'Over time', beside((r) => !!r.history &&
    new History(r, timeline, String(results.indexOf(r))).content)));
  timeline.onChange(redrawMarks);
}
if (results.some((r) => r.probes.length > 0)) {
  page.append(section('probes', 'Probes', beside((r) => r.probes.length > 0 &&
    probes(r, timeline, String(results.indexOf(r))))));
  if (!results.some((r) => r.history)) timeline.onChange(redrawMarks);
}
for (const id of ['contact', 'history', 'probes']) {
  const charts = document.getElementById(id);
  if (charts && several) bothInOne(charts, results.map((r) => r.title));
}
page.append(section('run', 'The run', beside((r) => runSection(r))));
if (timeline.times.length > 1) {
  timeline.bar.append(playback(timeline));
  document.body.append(timeline.bar);
}
