// Live numbers and plots. The numbers' HTML is made by the daemon; this puts it in place.
'use strict';
(() => {
  const pollEveryMs = 5000;
  const silentAfterMs = 40000;  // the daemon says something every 15 s
  const historyEveryMs = 60000;
  const link = document.getElementById('link');
  const numbers = document.getElementById('numbers');
  const plots = {};
  let history = null;
  let heard = Date.now();
  let eventsShown = -1;
  let ended = false;

  function say(state, text) {
    link.className = 'badge ' + state;
    link.textContent = text;
  }

  function away() {
    if (ended) say('', 'the campaign has ended');
    else say('lost', 'daemon away');
  }

  // Section by section, and only what differs: a selection, a scrolled list stay as they are.
  function showNumbers(html) {
    const fresh = document.createElement('template');
    fresh.innerHTML = html;
    for (const section of fresh.content.querySelectorAll('section')) {
      const shown = document.getElementById(section.id);
      if (!shown) numbers.append(section);
      else if (shown.outerHTML !== section.outerHTML) shown.replaceWith(section);
    }
  }

  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const boardColour = (i) => colour('--plot-' + (1 + i % 4));
  const hours = (t) => t / 3600;

  function column(name) {
    return history.boards.map((board) => board[name]);
  }

  function rows(columns) {
    return history.t_s.map((t, i) => [hours(t), ...columns.map((values) => values[i])]);
  }

  // With a single point or none there is nothing to draw a line through.
  function draw(id, labels, columns, colours, options) {
    const element = document.getElementById(id);
    const data = rows(columns);
    if (data.length < 2) return;
    if (plots[id]) {
      plots[id].updateOptions({file: data, labels: ['h', ...labels], colors: colours});
      return;
    }
    plots[id] = new Dygraph(element, data, Object.assign({
      labels: ['h', ...labels], colors: colours, legend: 'always', strokeWidth: 1.4,
      gridLineColor: colour('--rule'), axisLineColor: colour('--rule'), axisLabelWidth: 46,
      labelsSeparateLines: false, highlightCircleSize: 3, connectSeparatedPoints: false,
      digitsAfterDecimal: 3, animatedZooms: false,
      labelsDiv: document.getElementById(id.replace('plot', 'legend')),
    }, options));
  }

  function drawAll() {
    const names = history.boards.map((board) => board.name);
    const colours = names.map((_, i) => boardColour(i));
    document.getElementById('plots').hidden = history.t_s.length < 2;
    draw('plot-temperature', ['setpoint', 'chamber', ...names],
         [history.setpoint_c, history.chamber_c, ...column('temperature_c')],
         [colour('--plot-0'), colour('--ink'), ...colours],
         {series: {setpoint: {strokePattern: [5, 4], stepPlot: true}}});
    draw('plot-rate', names, column('rate_z_dps'), colours, {});
    const limit = history.slope_limit_k_per_h;
    draw('plot-slope', names, column('slope_k_per_h'), colours, {
      includeZero: true,
      underlayCallback: (canvas, area, plot) => {
        const top = plot.toDomYCoord(limit);
        const bottom = plot.toDomYCoord(-limit);
        canvas.save();
        canvas.globalAlpha = 0.12;
        canvas.fillStyle = colour('--good');
        canvas.fillRect(area.x, top, area.w, bottom - top);
        canvas.restore();
      },
    });
  }

  async function fetchHistory() {
    try {
      history = await (await fetch('/api/history')).json();
      drawAll();
    } catch { /* the link's own badge says that the daemon is away */ }
  }

  function appendPoint(status) {
    if (!history || status.t_s === undefined) return;
    const last = history.t_s[history.t_s.length - 1];
    if (last !== undefined && status.t_s <= last) {
      if (status.t_s < last - 3600) history = null;  // another campaign
      return;
    }
    history.t_s.push(status.t_s);
    history.chamber_c.push(status.chamber.stale ? null : status.chamber.temperature_c);
    history.setpoint_c.push(status.chamber.stale ? null : status.chamber.setpoint_c);
    status.boards.forEach((board, i) => {
      if (!history.boards[i]) return;
      history.boards[i].temperature_c.push(board.present ? board.temperature_c : null);
      history.boards[i].rate_z_dps.push(board.present ? board.rate_dps[2] : null);
      history.boards[i].slope_k_per_h.push(board.present ? board.slope_k_per_h : null);
    });
    drawAll();
  }

  function hear() {
    heard = Date.now();
    say('live', 'live');
  }

  function follow() {
    const stream = new EventSource('/api/stream');
    stream.addEventListener('status', (event) => {
      const status = JSON.parse(event.data);
      hear();
      ended = ['finished', 'aborted', 'safe'].includes(status.state);
      document.title = `${status.setpoints_done ?? 0}/${status.setpoints} ${status.state} · ` +
          `${status.campaign}`;
      if (status.events_total < eventsShown) fetchHistory();
      eventsShown = status.events_total;
      appendPoint(status);
    });
    stream.addEventListener('numbers', (event) => showNumbers(event.data));
    stream.onerror = () => {
      away();
      if (stream.readyState === EventSource.CLOSED) {  // refused: too many pages, or it restarts
        poll();
        setTimeout(follow, pollEveryMs);
      }
    };
    stream.onopen = fetchHistory;
  }

  async function poll() {
    try {
      const answer = await fetch('/numbers');
      if (!answer.ok) return;
      showNumbers(await answer.text());
      hear();
    } catch {
      away();
    }
  }

  setInterval(() => {
    if (Date.now() - heard > silentAfterMs) away();
  }, 5000);
  setInterval(fetchHistory, historyEveryMs);
  const recolour = () => {
    for (const id of Object.keys(plots)) {
      plots[id].destroy();
      delete plots[id];
    }
    if (history) drawAll();
  };
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', recolour);
  follow();
})();
