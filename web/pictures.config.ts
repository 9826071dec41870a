import { defineConfig } from '@playwright/test';

import tests from './playwright.config';

// The pictures of the guides, made one after the other.
export default defineConfig({ ...tests, testMatch: 'paper_pictures.ts', workers: 1 });
