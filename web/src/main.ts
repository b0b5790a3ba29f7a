// Puts the page together.
import 'uplot/dist/uPlot.min.css';
import './style.css';
import { Body } from './body';
import { arranged } from './arrangement';
import { bothInOne } from './both_in_one';
import { redrawMarks, shareAxes } from './chart';
import { mapsNamed } from './colour_maps';
import { useColourMaps } from './colours';
import { Contact } from './contact';
import { ContactFace, shareFaceColours } from './contact_face';
import { element, tick } from './dom';
import { Explorer } from './explorer';
import { History } from './history';
import { stepAt, stepEnds } from './contact_line';
import { isReached, notReached, strayStep } from './moments';
import { shown } from './numbers';
import { playback } from './playback';
import { endsOfLine, probeLines } from './probe_lines';
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
  return element('section', { id, 'aria-labelledby': `${id}-title` },
    element('h2', { id: `${id}-title` }, title, ['overview', 'fields', 'contact'].includes(id) && printedMoment()), ...content);
}

/** The moment, for paper, which has no time bar. */
function printedMoment(): HTMLElement {
  const text = element('span', { class: 'printed' });
  const say = () => { text.textContent = `, t = ${shown(timeline.time)} s`; };
  timeline.onChange(say);
  say();
  return text;
}

/** The same part of each result, side by side where there is room. */
function beside(make: (result: Result) => HTMLElement | false): HTMLElement {
  return element('div', { class: `beside beside-${results.length}` }, ...results.map((result) => element('div', {},
    several && element('h3', { class: 'whose' }, result.title), make(result))));
}

/** Which of the runs does not reach the moment. */
/** `endsOf`: of the steps of what the section shows [s] */
function strays(endsOf: (result: Result) => number[]): HTMLElement {
  const box = element('div', { class: `beside beside-${results.length}` }, ...results.map(() => element('p', { class: 'stray', role: 'status' })));
  const say = () => results.forEach((result, i) => {
    const ends = endsOf(result), { time } = timeline;
    box.children[i].textContent = !isReached(result, time) ? notReached(result) : ends.length > 0 ? strayStep(ends, stepAt(ends, time), time) : '';
  });
  timeline.onChange(say);
  say();
  return box;
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
const timeline = new Timeline(results);
timeline.bar.append(playback(timeline));
new ResizeObserver(() => document.documentElement.style.setProperty('--bar', `${timeline.bar.offsetHeight}px`)).observe(timeline.bar);
startTheme();
page.append(header(), ...(timeline.moments.length > 1 ? [timeline.bar] : []), ...[notices()].filter((n): n is HTMLElement => !!n));

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

/** Whether the charts of a section have the same axes for both runs. */
const axesChoice = (...groups: string[]) => several &&
  tick('same axes', true, (on) => {
    for (const group of groups) shareAxes(group, on);
    if (groups.includes('contact')) shareFaceColours(on);
  });

if (results.some((r) => r.contact && r.contact.rows > 0)) {
  const contacts = new Map(results.filter((r) => r.contact && r.contact.rows > 0).map((r) => [r, r.dimension === 2
    ? new Contact(r, timeline, String(results.indexOf(r))) : new ContactFace(r, timeline)] as const));
  page.append(section('contact', 'Along the contact', axesChoice('contact'), strays((r) => (r.contact?.rows ? stepEnds(r) : [])),
    arranged(results, (r) => contacts.get(r)?.groups ?? [])));
  const update = () => { for (const contact of contacts.values()) contact.update(); };
  timeline.onChange(update);
  onMap.push(update);
}
if (results.some((r) => r.history)) {
  page.append(section('history', 'Over time', axesChoice('history'), arranged(results, (r) => (r.history
    ? [{ key: '', cells: new History(r, timeline, String(results.indexOf(r))).cells }] : []))));
  timeline.onChange(redrawMarks);
}
if (results.some((r) => r.probes.length + r.lines.length > 0)) {
  const names = [...new Set(results.flatMap((r) => [...r.probes, ...r.lines].map(({ name }) => `probe ${name}`)))];
  page.append(section('probes', 'Probes', axesChoice(...names), strays((r) => (r.lines.length > 0 ? endsOfLine(r.lines[0].table) : [])),
    arranged(results, (r) => [probes, probeLines].flatMap((of) => of(r, timeline, String(results.indexOf(r)))))));
  if (!results.some((r) => r.history)) timeline.onChange(redrawMarks);
}
for (const id of ['contact', 'history', 'probes']) {
  const charts = document.getElementById(id);
  if (charts && several) bothInOne(charts, results.map((r) => r.title));
}
page.append(section('run', 'The run', beside((r) => runSection(r))));
