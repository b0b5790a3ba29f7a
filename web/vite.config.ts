import { defineConfig } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

export default defineConfig({
  plugins: [viteSingleFile({ removeViteModuleLoader: true })],
  build: {
    outDir: process.env.TOURMALINE_PAGE_FOLDER ?? 'dist',
    emptyOutDir: true,
    target: 'es2020',
    reportCompressedSize: false,
  },
  logLevel: 'warn',
});
