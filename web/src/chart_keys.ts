// Charts without a mouse: the legend shows and hides curves, arrow keys go from point to point.
import uPlot from 'uplot';

/** Of a chart just made. */
export function takeKeys(plot: uPlot, title: string) {
  const legend = plot.root.querySelector('.u-legend');
  legend?.setAttribute('role', 'group');
  legend?.setAttribute('aria-label', `curves of ${title}`);
  plot.root.querySelectorAll<HTMLElement>('.u-series').forEach((row, i) => {
    if (i > 0) takeLegendKeys(plot, row.querySelector<HTMLElement>('th')!, i);
  });
  takeCursorKeys(plot, title);
}

function takeLegendKeys(plot: uPlot, label: HTMLElement, series: number) {
  label.tabIndex = 0;
  label.setAttribute('role', 'button');
  const say = () => label.setAttribute('aria-pressed', String(plot.series[series].show ?? true));
  say();
  label.addEventListener('click', () => setTimeout(say));
  label.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter' && event.key !== ' ') return;
    event.preventDefault();
    label.click();
  });
}

function takeCursorKeys(plot: uPlot, title: string) {
  plot.over.tabIndex = 0;
  plot.over.setAttribute('role', 'img');
  plot.over.setAttribute('aria-label', `${title}; arrow keys go from point to point`);
  plot.over.addEventListener('keydown', (event) => {
    const last = plot.data[0].length - 1, at = plot.cursor.idx;
    const next: Record<string, number> = { ArrowLeft: (at ?? last + 1) - 1, ArrowRight: (at ?? -1) + 1, Home: 0, End: last };
    if (event.key === 'Escape') plot.setCursor({ left: -10, top: -10 });
    else if (event.key in next) {
      const i = Math.max(0, Math.min(last, next[event.key]));
      plot.setCursor({ left: plot.valToPos(plot.data[0][i], 'x'), top: plot.over.clientHeight / 2 });
    } else return;
    event.preventDefault();
  });
}
