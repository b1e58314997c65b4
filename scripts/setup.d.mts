export declare const ROOT: string;
export declare function ensureDependencies(): void;
export declare function ensureBuild(): void;
