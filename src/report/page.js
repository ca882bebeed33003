(function () {
  'use strict';
  var form = document.getElementById('filter'), table = document.getElementById('claims');
  var rows = Array.prototype.slice.call(table.tBodies), due = false;
  function el(id) { return document.getElementById(id); }
  function is(key, row, value) { return value === '' || row.dataset[key] === value; }
  function has(row, words) { return words.every(function (w) { return row.textContent.toLowerCase().indexOf(w) !== -1; }); }
  function filter() {
    var words = el('by-t').value.toLowerCase().split(' '), route = el('by-r').value, n = 0;
    rows.forEach(function (row) {
      var all = [is('v', row, el('by-v').value), is('s', row, el('by-s').value),
        route === '' || row.dataset.r.indexOf(' ' + route + ' ') !== -1, has(row, words)];
      row.hidden = all.indexOf(false) !== -1;
      n += row.hidden ? 0 : 1;
    });
    el('shown').textContent = n + ' of ' + rows.length + ' claims shown';
  }
  function sort() {
    var worst = el('order').value === 'w';
    rows.slice().sort(function (a, b) {
      return (worst ? a.dataset.w - b.dataset.w : 0) || rows.indexOf(a) - rows.indexOf(b);
    }).forEach(function (row) { table.appendChild(row); });
  }
  function arrive() {
    var target = document.getElementById(decodeURIComponent(location.hash.slice(1))), fold = target;
    if (!target) return;
    while ((fold = fold.closest('details'))) { fold.open = true; fold = fold.parentElement; }
    if (rows.indexOf(target) !== -1) {
      if (target.hidden) { form.reset(); sort(); filter(); }
      target.querySelector('details').open = true;
    }
    target.scrollIntoView();
  }
  function folded(e) {
    var summary = e.closest('summary');
    return (summary ? summary.parentElement.parentElement : e).closest('details:not([open])') !== null;
  }
  function reach() {
    due = false;
    Array.from(document.querySelectorAll('.wide, .tex')).filter(function (box) {
      return folded(box) ? false : box.scrollWidth > box.clientWidth;
    }).forEach(function (box) { box.tabIndex = 0; });
  }
  function reach_soon() {
    if (!due) setTimeout(reach, 0);
    due = true;
  }
  form.hidden = false;
  form.addEventListener('input', function (e) { if (e.target.id === 'order') sort(); else filter(); });
  form.addEventListener('submit', function (e) { e.preventDefault(); });
  form.addEventListener('reset', function () { setTimeout(function () { sort(); filter(); }, 0); });
  el('open').addEventListener('click', function () {
    rows.forEach(function (row) { if (!row.hidden) row.querySelector('details').open = true; });
  });
  el('theme').hidden = false;
  el('theme').addEventListener('click', function () {
    var root = document.documentElement, dark = matchMedia('(prefers-color-scheme: dark)').matches;
    var now = root.dataset.theme || (dark ? 'dark' : 'light');
    root.dataset.theme = now === 'dark' ? 'light' : 'dark';
  });
  document.addEventListener('toggle', reach_soon, true);
  window.addEventListener('hashchange', arrive);
  window.addEventListener('resize', reach);
  filter();
  reach();
  arrive();
}());
