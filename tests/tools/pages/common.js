// What the pages share: a picture of points, four numbers a pixel, and of what the functions give for them.
export const WIDTH = 256;
export const text = async (path) => (await fetch(path)).text();

export async function loadPoints() {
    const points = new Float32Array(await (await fetch('/case/points.f32')).arrayBuffer());
    const count = points.length / 4, height = Math.ceil(count / WIDTH);
    const texels = new Float32Array(4 * WIDTH * height);
    texels.set(points);
    return { points, count, height, texels };
}

const post = (path, body) => fetch(path, { method: 'POST', body });

// Gives what `main` resolves to as the page's result. Engines report shaders that do not compile on the
// console alone.
export function run(main) {
    const line = (values) => values.map((value) => value?.message ?? String(value)).join(' ');
    const fail = (error) => post('/error', String(error?.stack ?? error));
    console.error = (...values) => fail(line(values));
    addEventListener('error', (event) => fail(event.error ?? event.message));
    addEventListener('unhandledrejection', (event) => fail(event.reason));
    main().then((values) => post('/result', values), fail);
}
