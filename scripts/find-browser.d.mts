export declare function findBrowser(): Promise<string | null>;
export declare function installBrowser(playwrightCli: string): Promise<string | null>;
