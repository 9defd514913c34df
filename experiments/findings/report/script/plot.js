import {colour, extent, head, label, ticks} from './scales.js';
import {drawLabels, drawMark} from './marks.js';
import {telling} from './telling.js';

// A figure of the page on a canvas: µPlot has axes, scales and zooming by the mouse, the marks are ours.
export class Plot {
  constructor(figure, picture) {
    this.figure = figure;
    this.picture = picture;
    this.box = figure.querySelector('.plot');
    this.zoomed = {x: null, y: null};
    this.view = document.createElement('div');
    this.view.className = 'canvas';
    this.box.append(this.view);
    this.tip = this.view.appendChild(document.createElement('div'));
    this.tip.className = 'tip';
    this.tip.hidden = true;
    this.draw();
    this.listen();
  }

  size() {
    const rows = this.picture.y.names?.length, cells = this.picture.marks.some(m => m.kind === 'cells');
    return {width: Math.max(240, this.box.clientWidth),
            height: rows ? Math.max(cells ? 220 : 90, 50 + (cells ? 34 : 28) * rows) : this.box.clientWidth < 420 ? 280 : 330};
  }

  axis(which) {
    const axis = this.picture[which], y = which === 'y';
    const longest = y && axis.names ? Math.max(...axis.names.map(n => n.length)) : 0;
    return {
      scale: which, label: head(axis) || undefined, labelSize: 20, labelFont: '12px system-ui, sans-serif', font: '12px system-ui, sans-serif',
      size: y ? (axis.names ? Math.min(0.4 * this.box.clientWidth, 7 * longest + 14) : 58) : 26, gap: 5,
      stroke: () => colour('soft'), grid: {stroke: () => colour('line'), width: 1, show: !(axis.names && !y)}, ticks: {show: false},
      splits: (u, i, from, to) => ticks(axis, from, to, Math.floor((y ? u.bbox.height : u.bbox.width) / uPlot.pxRatio / (y ? 44 : 68))),
      filter: (u, all) => all, values: (u, all) => all.map(v => this.fit(label(axis, v), which)),
    };
  }

  // A name that is too long for a narrow page loses its middle.
  fit(name, which) {
    const room = which === 'y' ? (0.4 * this.box.clientWidth - 12) / 7.2 : this.picture.x.names ? 0.8 * this.box.clientWidth / this.picture.x.names.length / 6.6 : 99;
    return name.length <= room ? name : name.slice(0, Math.max(1, room - 5)) + '…' + name.slice(-3);
  }

  draw() {
    const {picture} = this, scale = which => ({
      time: false, distr: picture[which].log ? 3 : 1, dir: which === 'y' && picture.y.names ? -1 : 1, auto: true,
      range: () => this.zoomed[which] ?? extent(picture, which),
    });
    this.u?.destroy();
    this.u = new uPlot({
      ...this.size(), mode: 2, pxAlign: 0, legend: {show: false}, scales: {x: scale('x'), y: scale('y')},
      axes: [this.axis('x'), this.axis('y')],
      cursor: {drag: {x: !picture.x.names, y: !picture.y.names, uni: 20, setScale: false}, points: {show: false}, focus: {prox: -1},
               bind: {dblclick: () => () => { this.zoom(); return null; }}},
      series: [null, ...picture.marks.map(mark => ({
        show: mark.shown !== false, facets: [{scale: 'x', auto: true}, {scale: 'y', auto: true}], points: {show: false},
        stroke: () => colour(mark.colour), paths: u => { drawMark(u, picture, mark); return null; },
      }))],
      hooks: {
        drawClear: [u => { u.labels = []; u.series.forEach(s => { s._paths = null; }); }],
        draw: [u => this.finish(u)],
        setSelect: [u => this.select(u)],
        setCursor: [u => this.hover(u)],
      },
    }, [null, ...picture.marks.map(m => [m.x, m.y])], this.view);
    this.view.append(this.tip);
  }

  finish(u) {
    u.ctx.save();
    u.ctx.font = `${11.5 * uPlot.pxRatio}px system-ui, sans-serif`;
    drawLabels(u.ctx, u.labels ?? [], u.bbox, uPlot.pxRatio);
    u.ctx.restore();
  }

  refresh() { this.u.setData(this.u.data); }

  select(u) {
    const s = u.select;
    if (s.width < 3 && s.height < 3) return;
    if (s.width > 0 && !this.picture.x.names) this.zoomed.x = [u.posToVal(s.left, 'x'), u.posToVal(s.left + s.width, 'x')];
    if (s.height > 0 && !this.picture.y.names && s.height < u.over.clientHeight) this.zoomed.y = [u.posToVal(s.top + s.height, 'y'), u.posToVal(s.top, 'y')];
    u.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
    this.refresh();
  }

  // By a factor about the middle or about the point that is told; without a factor all is seen again.
  zoom(factor, shift = [0, 0]) {
    for (const [k, which] of ['x', 'y'].entries()) {
      const axis = this.picture[which];
      if (axis.names) continue;
      if (!factor) { this.zoomed[which] = null; continue; }
      const [to, back] = axis.log ? [Math.log10, v => 10 ** v] : [v => v, v => v];
      const s = this.u.scales[which], low = to(s.min), high = to(s.max), told = this.told && this.picture.marks[this.told.mark][which][this.told.i];
      const middle = (told != null && factor !== 1 && told >= s.min && told <= s.max ? to(told) : (low + high) / 2) + shift[k] * (high - low);
      const part = factor === 1 ? 0.5 : (middle - low) / (high - low);
      this.zoomed[which] = [back(middle - part * (high - low) / factor), back(middle + (1 - part) * (high - low) / factor)];
    }
    this.refresh();
  }

  choose(name) {
    const marks = this.picture.marks, of = marks.filter(m => m.name === name), now = of[0].shown !== false;
    if (this.picture.exclusive) marks.forEach(m => { if (m.name) m.shown = m.name === name; });
    else of.forEach(m => { m.shown = !now; });
    this.figure.querySelectorAll('.legend button').forEach(b =>
      b.setAttribute('aria-pressed', String(marks.some(m => m.name === b.dataset.name && m.shown !== false))));
    marks.forEach((m, i) => { this.u.series[i + 1].show = m.shown !== false; });
    this.told = null;
    this.tip.hidden = true;
    this.refresh();
  }

  listen() {
    this.figure.querySelectorAll('.legend button').forEach(b => b.addEventListener('click', () => this.choose(b.dataset.name)));
    this.box.addEventListener('keydown', e => this.key(e));
    this.box.addEventListener('click', e => { if (this.told && !e.target.closest('button')) this.copy(); });
    this.view.addEventListener('wheel', e => {
      if (!e.ctrlKey && !e.metaKey) return;
      e.preventDefault();
      this.zoom(e.deltaY < 0 ? 1.25 : 0.8);
    }, {passive: false});
    let width = this.box.clientWidth;
    new ResizeObserver(() => {
      if (this.box.clientWidth === width || this.box.clientWidth === 0) return;
      width = this.box.clientWidth;
      this.draw();
    }).observe(this.box);
  }
}

Object.assign(Plot.prototype, telling);
